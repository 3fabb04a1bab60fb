"""waiter_cli/rules"""
