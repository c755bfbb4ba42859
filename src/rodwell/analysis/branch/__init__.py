"""What users hold, solutions, branches, diagrams, and how branches are followed."""
