"""What comes next: suggestions merged into the author's file, and the next step after a fit."""
