"""sparc/translation"""
