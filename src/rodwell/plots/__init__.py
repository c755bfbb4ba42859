"""Figures. They compute nothing."""
