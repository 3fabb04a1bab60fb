"""waiter_cli/translators"""
