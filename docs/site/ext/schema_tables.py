def tables(s): return ""
