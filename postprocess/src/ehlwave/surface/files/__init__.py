"""Files of measured surfaces as instruments write them: text, arrays, HDF5, binary formats.

``by_content`` chooses the reader. Text passes ``rows`` (the block of numbers), ``decimals``,
``statements`` (steps and units above the numbers) and ``columns`` (roles by headings, ``words``).
"""
