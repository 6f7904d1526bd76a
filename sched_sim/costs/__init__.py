"""What each job of each method costs: tables, operations and samples, and the files they are in."""
