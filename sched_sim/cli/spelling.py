"""How the command line spells the name of an argument."""


def flag_of(name: str) -> str:
    return f"-{name}" if len(name) == 1 else f"--{name.replace('_', '-')}"
