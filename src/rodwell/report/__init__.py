"""The report and the results folder."""
