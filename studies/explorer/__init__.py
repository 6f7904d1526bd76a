"""What is known of one design, as plain data: its schedule, staircases, accuracy and parts, and the answer in words."""
