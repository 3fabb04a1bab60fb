"""waiter_cli/console"""
