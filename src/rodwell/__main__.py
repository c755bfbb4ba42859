"""``python -m rodwell``."""

from rodwell.cli.main import main

main()
