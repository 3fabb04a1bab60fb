"""waiter_cli/pictures"""
