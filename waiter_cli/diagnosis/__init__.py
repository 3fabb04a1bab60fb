"""waiter_cli/diagnosis"""
