"""waiter_cli/problems"""
