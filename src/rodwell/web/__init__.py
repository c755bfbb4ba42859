"""The live explorer: a page in the browser and the server behind it, on this machine only."""
