"""waiter_cli/planning"""
