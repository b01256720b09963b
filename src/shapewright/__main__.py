"""``python -m shapewright``: the command line."""

from shapewright.cli.main import main

if __name__ == "__main__":
    main()
