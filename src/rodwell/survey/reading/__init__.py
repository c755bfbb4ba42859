"""Reading surveys from files: text, workbooks, LAS; which column is which, units, numbers, missing values."""
