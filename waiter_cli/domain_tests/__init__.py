"""waiter_cli/domain_tests"""
