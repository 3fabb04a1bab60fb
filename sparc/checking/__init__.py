"""sparc/checking"""
