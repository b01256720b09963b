"""Long texts of numbers, read at the speed of C."""
