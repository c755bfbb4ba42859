"""Surveys and centre lines: read from files, and the smooth axis of a hole through them."""
