"""waiter_cli/explanation"""
