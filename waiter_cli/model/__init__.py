"""waiter_cli/model"""
