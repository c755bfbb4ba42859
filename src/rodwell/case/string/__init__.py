"""Strings of sections: how case files say them, tool joints between bodies of pipe, and what becomes of both."""
