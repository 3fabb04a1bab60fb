"""waiter_cli/encoding"""
