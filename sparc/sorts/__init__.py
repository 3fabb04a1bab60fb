"""sparc/sorts"""
