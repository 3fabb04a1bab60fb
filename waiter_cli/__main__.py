"""``python -m waiter_cli`` is ``waiter``."""

from waiter_cli.app import main

if __name__ == "__main__":
    main()
