"""Random programs in the part of the language that is translated."""

from __future__ import annotations

from random import Random

HEADER = "import numpy as np\n\n"


class Program:
    """A function of reals a, b, whole numbers i, j >= 0, and arrays x (4,), P (3, 3); in range whatever it does."""

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)
        self._reals, self._wholes = ["a", "b"], ["i", "j"]
        self._loops = 0

    def text(self, name: str) -> str:
        body = self._block(3, 5)
        return f"def {name}(a, b, i, j, x, P):\n{body}    return {self._real(2)}\n"

    def _block(self, depth: int, most: int, indent: str = "    ") -> str:
        known = list(self._reals), list(self._wholes)
        lines = "".join(self._statement(depth, indent) for _ in range(self._random.randint(1, most)))
        if indent != "    ":
            self._reals, self._wholes = known  # what is assigned in a branch only is not known behind it
        return lines

    def _statement(self, depth: int, indent: str) -> str:
        kind = self._random.choice(["real", "real", "whole", "element", "element", "add", "if", "for", "while", "swap"])
        deeper = indent + "    "
        match kind:
            case "if" if depth:
                text = f"{indent}if {self._flag()}:\n{self._block(depth - 1, 2, deeper)}"
                return text + (
                    f"{indent}else:\n{self._block(depth - 1, 2, deeper)}" if self._random.random() < 0.5 else ""
                )
            case "for" if depth and self._loops < 2:
                self._loops += 1
                variable = f"n{self._loops}{self._random.randint(0, 999)}"
                bounds = self._random.choice(["3", "1, 4", "3, 0, -1", "0, 6, 2", f"{self._whole(1)} % 4"])
                self._wholes.append(variable)
                body = self._block(depth - 1, 3, deeper)
                self._wholes.remove(variable) if variable in self._wholes else None
                self._loops -= 1
                stop = self._random.choice(["", f"{deeper}if {self._flag()}:\n{deeper}    break\n"])
                return f"{indent}for {variable} in range({bounds}):\n{body}{stop}"
            case "while" if depth and self._loops == 0:
                return (
                    f"{indent}while abs(b) > 2.0 and abs(b) < 1e30:\n{deeper}b = b / {self._random.randint(3, 9)}.0\n"
                )
            case "whole":
                name = self._random.choice([*self._wholes[:2], f"m{self._random.randint(0, 3)}"])
                text = f"{indent}{name} = abs({self._whole(2)}) % 97\n"
                self._wholes += [name] if name not in self._wholes else []
                return text
            case "add":
                name, sign = self._random.choice(self._reals), self._random.choice(["+=", "-=", "*="])
                return f"{indent}{name} {sign} {self._real(1)}\n"
            case "element":
                place = self._random.choice([f"x[{self._index(4)}]", f"P[{self._index(3)}, {self._index(3)}]"])
                return f"{indent}{place} = {self._real(2)}\n"
            case "swap":
                first, second = self._random.sample(self._reals, 2)
                return f"{indent}{first}, {second} = {second}, {self._real(1)}\n"
        name = self._random.choice([*self._reals, f"c{self._random.randint(0, 3)}"])
        text = f"{indent}{name} = {self._real(2)}\n"
        self._reals += [name] if name not in self._reals else []
        return text

    def _index(self, length: int) -> str:
        return self._random.choice([str(self._random.randrange(-length, length)), f"{self._whole(1)} % {length}"])

    def _real(self, depth: int) -> str:
        pick = self._random.choice
        if depth == 0 or self._random.random() < 0.2:
            return pick(
                [*self._reals, *self._wholes, "0.5", "-1.25", "3", f"x[{self._index(4)}]", "P[1, 2]", "P[2][0]"]
            )
        a, b = self._real(depth - 1), self._real(depth - 1)
        return pick(
            [
                f"({a} {pick('+-*')} {b})",
                f"{a} {pick('+-*')} {b}",
                f"({a}) / (2.0 + abs({b}))",
                f"-{a}",
                f"-({a} - {b})",
                f"max({a}, {b})",
                f"min({a}, {b})",
                f"np.sqrt(abs({a}))",
                f"({a} if {self._flag()} else {b})",
                f"(1.0 * ({a})) ** 2",
                f"np.floor(0.1 * ({a}))",
            ]
        )

    def _whole(self, depth: int) -> str:
        pick = self._random.choice
        if depth == 0:
            return pick([*self._wholes, str(self._random.randint(0, 9)), "len(x)", "P.shape[1]"])
        a, b = self._whole(depth - 1), self._whole(depth - 1)
        return pick(
            [f"({a} + {b})", f"({a} - {b})", f"{a} * {b} % 13", f"({a} - 7) // {self._random.randint(1, 5)}", a]
        )

    def _flag(self) -> str:
        pick = self._random.choice
        return pick(
            [
                f"{self._real(1)} {pick(['<', '>=', '!='])} {self._real(0)}",
                f"{self._whole(1)} {pick(['<', '==', '>'])} {self._whole(0)}",
                f"not ({self._real(0)} > 0.0 and {self._whole(0)} != 3)",
                f"0.0 < {pick(self._reals)} <= 2.0 or {self._whole(0)} > 5",
            ]
        )
