"""What jobs take: counted or timed, of the methods here or of a model or filter of the user."""
