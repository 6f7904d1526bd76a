"""What the pages of all reports share: numbers, stored tables, rendering."""
