"""What is shown: Gantt charts, figures and the rendered reports."""
