"""Files for the readers of input files: written by handwith their outcomes, and drawn."""

import random

MARK = b"\xef\xbb\xbf"
A = b"&conditions load_n = 40 /\n"

READ = [
    A, A[:-1], MARK + A, A.replace(b" /", b"\r\n/\r\n"), A.replace(b" /", b"\r/\r"), A.upper(),
    b"! caf\xe9 at 40 \xb0C, &x / = '\n" + A, b"&a x = 1.0d-3, y = 1e5, z = 1D+03 w = .5 v = 5. /", b"&a x = 3*1.0, 2*'b', 1*\"c\" /",
    b"&a x = 'it''s', y = \"say \"\"x\"\"\", z = '\"', u = '' /", b"&a x = 'a ! b / c' ! d / e\n/", b"&a x = 1,\n 2,\n ! 3,\n 4 /",
    b"&a\tx\t=\t1\t/", b"&a x = 1, y = 2, /", b"&a x = 1 2 3 /", b"&a /", b"&a / &b /", b"&a /&b /", b"& a x = 1 /",
    b"&a x = .true., y = T, z = f, u = .F., v = False, w = .t. /", b"&a x = nan, y = inf, z = 1e400, u = -1e-400, v = 1e308 /",
    b"&a x = 9.99e307, y = 1e-307, z = 9.9e-308, u = 0e999, v = -0.0 /", b"&a x = 2147483647, y = -2147483648, z = 99999999999999999999 /",
    b"&a x = a%b, y = $c, z = 1.5.2, u = 1e, v = --1, w = +1 /", b"&a x = 1e0000000000000000001, y = 1e-00000000000000003 /",
    b"&a x = 0.000000000000000000000000000000000001e40, y = 1" + b"0"*300 + b"e-300 /", b"&a x = '\xe9\xc3\xa9' /", b"&a x = 1e1000000 /",
    b"&a x = 1_8, y = 0x1F, z = 1,5 /", b"&a x = 'b' 'c' /", b"&" + b"a"*63 + b" /", b"&a x = 100000*1 /", b"&a x = *1, y = a*b, z = -3*1 /",
    b"&end x = 1 /", b"&a x = '" + b"n"*10**6 + b"' /", b"&a x = " + b"1"*10**6 + b" /", b" "*10**6 + A, b"!" + b"x"*10**6 + b"\n" + A,
    b"&a x = )]}{[:;@#^~`|\\<>? /", b"&a\nx=1/!end\n", b"&a x = 1 !c\r/\n\r&b y = 2 /", b"&a x = '\x1b[2J\t\x07' /", b"&a x = 1\n/", b"&a x => 1 /",
]
REFUSED = [
    b"", b"\n", MARK, b"! nothing\n", b"x = 1\n", b"&a\n", b"&a x = 1\n", b"&a x = 1 &b y = 2 /", b"&a x = 1 &end", b"$a x = 1 $end",
    b"$a x = 1 /", A + b"&CONDITIONS load_n = 3 /", b"&a x = 1, X = 2 /", b"&a x = 1/2 /", b"&a x = /", b"&a x = , /", b"&a x = 1,, 2 /",
    b"&a x = y = 1 /", b"&a x 1 /", b"&a = 1 /", b"&a , x = 1 /", b"&a x(1) = 1 /", b"&a x = 1, y(2) = 3 /", b"&a x%y = 1 /", b"&a (1) /",
    b"&a x = (1, 2) /", b"&a 1x = 1 /", b"&a _x = 1 /", b"&a x-y = 1 /", b"&1a x = 1 /", b"&" + b"a"*64 + b" /", b"&a " + b"k"*64 + b" = 1 /",
    b"&a x = 'b\n' /", b"&a x = 'b /", b"&a x = \"b' /", b"&a x = b'c' /", b"&a x = 'b'c /", b"&a x = 'b'\"c\" /", b"&a x = 0*1 /",
    b"&a x = 3* /", b"&a x = 3* 1 /", b"&a x = 99999999*1 /", b"&a x = 9999999999*1 /", b"&a x = 100000*1, 2 /", b"&a x = 3*'b'c /",
    b"&a x = 1 / y = 2 /", b"&a x = 1 // &b /", b"&a x = 1 /x", b"&a x = 1 / 'x'", b"&a x = 1 /\n/\n", b"&a x = 1\x00 /", b"&a x = \xa01 /",
    "&a x = \u201cb\u201d /".encode(), b"&a x = 1\xc2\xa0/", b"&a x = 1\x0c/", b"&a \x1bx = 1 /", b" " + MARK + A, MARK + MARK + A, A[1:],
    A.decode().encode("utf-16"), b"\x89PNG\r\n\x1a\n" + A, b"&a x = " + b"'"*(10**6 + 1) + b" /", b"&a " + b"k"*10**6 + b" = 1 /", b"& /", b"&",
    b"&a\n" + b" x = 1\n"*1000 + b"/\n", b"&a x = " + b"1, "*100000 + b"1 /", b"&a x == 1 /", b"&a x =\n! 1\n/",
    b"&a x = 'b\r' /", b"&a &b /", b"&a'b' /", b"&a x = 1/ ! c\n2 /", b"#\n" + A, b"\x1a", b"{\"a\": 1}", b"[a]\nx = 1\n", A + b"\x1a",
]
WRITTEN = [(text, True) for text in READ] + [(text, False) for text in REFUSED]
"""Bytes of a file, and whether the readers take it."""

OF_KEYS = [
    b"&lubricant flow_law = 'Eyring  ' /", b"&lubricant flow_law = ' eyring' /", b"&lubricant flow_law = 'eyring\t' /", b"&lubricant flow_law = '' /",
    b"&lubricant flow_law = eyring /", "&lubricant flow_law = 'e\u0178ring' /".encode(), b"&waviness2 orientation = 'custom' /",
    b"&waviness2 orientation_2 = 'custom', orientation = 'custom' /", b"&waviness orientation_2 = 'custom' /", b"&surface2 file = 'a.h5' /",
    b"&surface file_2 = 'a.h5' /", b"&surface file = '' /", b"&surface file = '" + b"n"*512 + b"' /", b"&surface file = '" + b"n"*513 + b"' /",
    "&surface file = '{}' /".format("\u00e9"*300).encode(), b"&surface file = 'a\xe9 ' /", b"&lubricant viscosity_table = '' /",
    b"&lubricant limiting_stress_over_pressure = 0.1 /", b"&heat /", b"&heat levels = 3 /", b"&heat levels = 4 /", b"&heat oil = 1 /", b"&inlet /", b"&touching /",
    b"&touching share_2 = 0.5 /", b"&touching law = 'hard' /",
    b"&conditions radius_x_m = 1e-6 /", b"&conditions radius_x_m = 0.99e-6 /", b"&conditions radius_x_m = 5.0000000000000001 /",
    b"&conditions radius_x_m = 5.000000000000001 /", b"&conditions load_n = 0 /", b"&conditions load_n = 1e-307 /", b"&conditions load_n = -0.0 /",
    b"&conditions slip_parameter = 2 /", b"&conditions slip_parameter = 2.0000001 /", b"&conditions slide_to_roll_ratio = -2d0 /",
    b"&grid cells_x = 8192 /", b"&grid cells_x = 8193 /", b"&grid cells_x = -0 /", b"&grid x_min = -1 /", b"&grid x_min = -0.999 /",
    b"&solver tolerance = 0.1 /", b"&solver tolerance = 0.10000000000000001 /", b"&solver tolerance = 0.100000000000001 /",
    b"&sweep output = 'a.h5' /", b"&conditions load_nn = 3 /", b"&output fields = T, mean_rise = .false. /", b"&output fields = 1 /",
    b"&conditions central_film_m = 1e-7 /", b"&lubricant yasutomi_b2 = -1e-6 /", b"&lubricant yasutomi_b2 = 0 /", b"&conditions load_n = 1, 2 /",
]
"""Files about kinds, bounds, choices and names of keys."""

NAMES = ["a", "load_n", "Load_N", "x", "conditions", "x1", "cells_x"]
WORDS = ["1", "1.5", "-3", "1e5", "1.0d-3", "2E+3", "3*1.0", "2*'b'", "'text'", '"it""s"', "'it''s'", "''", ".true.", "F", "nan", "-inf",
         "1e400", "1e-400", "'a!b/c'", "word", "1.", ".5", "+7", "00012", "1e+07", "1.5.2", "'\u00e9'", "1d0", "9007199254740993"]
ODD = ["&", "/", "=", ",", "(", ")", "%", "$", "!", "'", '"', "1/2", "x(1)", "&end", "\x00", "\x0c", "\u00b0", "*", "2*", "0*1"]
BLANKS = [" ", " ", " ", "\n", "\t", "\r\n", "\r", "  ", " ! note / & = '\n", "!\u00b0\n"]


class Drawing:
    """Files of the grammar with a few things in them that break it."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def next(self):
        """A further file."""
        draw = self.random
        oddness = draw.choice([0, 0, 0.01, 0.05])
        parts = ["\ufeff"] if draw.random() < 0.1 else []
        for number in range(draw.randint(1, 4)):
            parts += [self.blank(oddness, 0.5), "&", f"{draw.choice(NAMES)}{number if draw.random() < 0.97 else ''}"]
            for key in range(draw.randint(0, 6)):
                parts += [self.blank(0, 1), f"{draw.choice(NAMES)}{key if draw.random() < 0.99 else ''}", self.blank(oddness, 0.5), "="]
                for value in range(draw.choice([1, 1, 1, 2, 3])):
                    parts += [draw.choice([",", " ", "\n", ", "]) if value else "", self.blank(oddness, 0.3), self.value()]
                parts.append(draw.choice(["", "", ","]))
            parts += [self.blank(oddness, 1), "/" if draw.random() < 0.97 else ""]
        text = "".join(parts) + draw.choice(["", "\n"])
        return text.encode(draw.choice(["utf-8", "utf-8", "latin-1"]) if "\ufeff" not in text else "utf-8")

    def value(self):
        """A value, or a number of random digits."""
        draw = self.random
        if draw.random() < 0.6:
            return draw.choice(WORDS)
        digits = "".join(draw.choice("0123456789") for _ in range(draw.randint(1, 25)))
        point = draw.randint(0, len(digits))
        exponent = f"{draw.choice('eEdD')}{draw.choice(['', '+', '-'])}{draw.choice([draw.randint(0, 20), draw.randint(270, 340)])}"
        return draw.choice(["", "-", "+"]) + digits[:point] + draw.choice([".", ""]) + digits[point:] + draw.choice(["", exponent])

    def blank(self, oddness, chance):
        """A separator, at times nothing, rarely a wrong character."""
        draw = self.random
        if draw.random() < oddness:
            return draw.choice(ODD)
        return draw.choice(BLANKS) if draw.random() < chance else ""


class KeyDrawing:
    """Files of keys with values inside their bounds, at them and outside."""

    def __init__(self, keys, seed):
        self.keys, self.random = keys, random.Random(seed)

    def next(self):
        """A further file: most of them have at most one odd value."""
        draw = self.random
        oddness = draw.choice([0, 0, 0.1, 0.3])
        groups = {}
        for name in draw.sample(sorted(self.keys), draw.randint(1, 6)):
            key = self.keys[name]
            group = key.group if draw.random() < 1 - oddness/10 else draw.choice(["grid", "sweep", "inlet"])
            written = key.short if key.short and draw.random() < 0.5 else name
            written = written if draw.random() < 1 - oddness/10 else written + draw.choice(["s", "_2", ""])
            groups.setdefault(group, {})[draw.choice([str, str.upper])(written)] = self.value(key, oddness)
        lines = [f"&{group} " + ", ".join(f"{name} = {value}" for name, value in values.items()) + " /"
                 for group, values in groups.items()]
        return "\n".join(lines).encode()

    def value(self, key, oddness):
        """A value for a key: of another kind, outside its bounds, at one of them or inside."""
        draw = self.random
        if draw.random() < oddness/2:
            return draw.choice(WORDS)
        if key.kind == "truth":
            return draw.choice(["T", ".false.", "true", "F"])
        if key.kind == "word":
            words = [*key.choices, *(["none", "auto", ""] if draw.random() < oddness else [])] or ["a.h5", "b c.csv", "d"*draw.randint(0, 600)]
            return f"'{draw.choice([str, str.upper])(draw.choice(words))}{' '*draw.choice([0, 0, 1])}'"
        bounds = [bound for bound in (key.above, key.minimum, key.maximum) if bound is not None]
        bound = draw.choice(bounds or [1])
        factor = draw.choice([1, 1, 1 + 1e-15, 1 - 1e-15, 0.5, 2, -1, 1 + 1e-9]) if draw.random() < oddness else 1
        low = max([bound for bound in (key.above, key.minimum) if bound is not None], default=-10)
        high = 1000 + max(0, low) if key.maximum is None else key.maximum
        number = bound*factor if draw.random() < 0.3 else low + (high - low)*draw.random()
        if key.kind == "whole":
            return str(int(number))
        return draw.choice(["{!r}", "{:.17e}", "{:.3g}"]).format(float(number)).replace("e", draw.choice("eEdD"))
