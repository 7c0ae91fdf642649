def measure(*a): pass
def table(*a): return ''
