"""The straight rod: its fields, critical loads, their derivatives, which mode is first."""
