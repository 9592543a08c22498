"""Executes the notebooks of this folder, and writes each as a page with its code, outputs and figures.

    python examples/notebooks/run.py [--out FOLDER] [NOTEBOOK…]

A notebook is a Python file in the percent format: `# %%` begins a cell of code, `# %% [markdown]` one of text.
A comment `# → 5.881` states what its line prints or what its value is; the run fails where that is not so.
Words must be equal, and a number may differ by half a unit of its last digit. Needs matplotlib and markdown.
"""

import argparse
import ast
import base64
import contextlib
import html
import io
import os
import re
import sys
import time
import traceback
import warnings
from pathlib import Path

HERE = Path(__file__).resolve().parent
ARROW = "# → "
LINK = re.compile(r'href="(?![a-z]+:|#)([^"]+)"')
STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:66rem;margin:2rem auto;padding:0 1rem;color:#222}
pre{background:#f5f5f2;padding:.7rem 1rem;overflow-x:auto;font-size:14px;line-height:1.4}
pre.out{background:none;margin-top:-.7rem;white-space:pre-wrap}
table{border-collapse:collapse;font-size:14px}td,th{border-bottom:1px solid #ddd;padding:.2rem .6rem;text-align:left}
img{max-width:100%}.wide{overflow-x:auto}"""


class Wrong(Exception):
    """A notebook that does not run, or says something else than it prints."""


def cells(text):
    """The cells: whether it is text, the first line, the source."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("# %%"):
            found.append((line.strip().endswith("[markdown]"), number + 1, []))
        elif found:
            found[-1][2].append(line)
        elif line.strip():
            raise Wrong(f"line {number} comes before the first cell, `# %%`")
    return [(is_text, first, "\n".join(lines)) for is_text, first, lines in found]


def agrees(printed, said):
    """Words are equal; a number differs by no more than half a unit of the last digit that is said."""
    ours, theirs = printed.split(), said.split()
    if len(ours) != len(theirs):
        return False
    for found, expected in zip(ours, theirs):
        try:
            mantissa, _, power = expected.lower().partition("e")
            digits = len(mantissa.partition(".")[2]) - int(power or 0)
            if abs(float(found) - float(expected)) > 0.5 * 10.0**-digits * (1 + 1e-9):
                return False
        except ValueError:
            if found != expected:
                return False
    return True


def figures(found):
    """The figures that a cell has drawn, which are then closed."""
    import matplotlib.pyplot as plt

    for number in plt.get_fignums():
        file = io.BytesIO()
        plt.figure(number).savefig(file, format="png", dpi=110)
        found.append(f'<img alt="figure" src="data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}">')
    plt.close("all")


def shown(value):
    """The value of a last line, as a notebook shows it."""
    if value is None or type(value).__module__.startswith("matplotlib"):
        return ""
    with contextlib.suppress(AttributeError):
        return f'<div class="wide">{value._repr_html_()}</div>'
    return f'<pre class="out">{html.escape(repr(value))}</pre>'


def execute(source, first, names, path):
    """Runs a cell, statement by statement; returns its outputs as HTML, and the number of arrows."""
    lines, found, output, arrows, said_at = source.splitlines(), [], "", 0, set()
    statements = ast.parse("\n" * (first - 1) + source, str(path)).body
    for statement in statements:
        last = lines[statement.end_lineno - first]
        printed, value = io.StringIO(), None
        with contextlib.redirect_stdout(printed), warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("default")
            if isinstance(statement, ast.Expr):
                value = eval(compile(ast.Expression(statement.value), str(path), "eval"), names)
            else:
                exec(compile(ast.Module([statement], []), str(path), "exec"), names)
        if ARROW in last:
            arrows, said = arrows + 1, last.partition(ARROW)[2]
            said_at.add(statement.end_lineno)
            text = printed.getvalue() or str(value)
            if not agrees(text, said):
                raise Wrong(f"line {statement.end_lineno} says {said}, but gives {text.strip()}")
        output += printed.getvalue()
        found += [f'<pre class="out">{html.escape(f"{one.category.__name__}: {one.message}")}</pre>' for one in heard]
        if statement is statements[-1]:
            found.append(f'<pre class="out">{html.escape(output.rstrip())}</pre>' if output else "")
            found.append(shown(value))
    idle = [first + i for i, line in enumerate(lines) if ARROW in line and first + i not in said_at]
    if idle:
        raise Wrong(f"line {idle[0]}: nothing ends there that {ARROW.strip()} could be checked against")
    figures(found)
    return "\n".join(found), arrows


def run(path, out):
    """Executes a notebook in its folder and writes its page; returns the number of arrows."""
    import markdown

    def moved(link):
        """A link to a file, from the page instead of the notebook."""
        return f'href="{Path(os.path.relpath(path.parent / link[1], out)).as_posix()}"'

    parts, total, title = [], 0, path.stem
    names = {"__name__": path.stem}
    for is_text, first, source in cells(path.read_text(encoding="utf-8")):
        if is_text:
            text = "\n".join(line.removeprefix("#").removeprefix(" ") for line in source.splitlines())
            heading = re.search(r"^# (.*)", text, re.M)
            title = heading[1] if heading and title == path.stem else title
            parts.append(LINK.sub(moved, markdown.markdown(text, extensions=["tables", "fenced_code"])))
            continue
        outputs, arrows = execute(source, first, names, path)
        total += arrows
        parts.append(f"<pre>{html.escape(source.strip())}</pre>\n{outputs}")
    page = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{html.escape(title)}</title>'
    page += f"<style>{STYLE}</style>\n"
    (out / f"{path.stem}.html").write_text(page + "\n".join(parts) + "</html>\n", encoding="utf-8")
    return total


def main():
    import matplotlib

    matplotlib.use("Agg")
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("--out", type=Path, default=HERE.parents[1] / "target" / "notebooks")
    arguments.add_argument("notebooks", nargs="*", type=Path, metavar="NOTEBOOK", help="default: all of this folder")
    given = arguments.parse_args()
    out = given.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    paths = [path.resolve() for path in given.notebooks] or sorted(HERE.glob("[0-9]*.py"))
    wrong = 0
    for path in paths:
        # As in Jupyter, paths of a notebook are relative to its folder.
        os.chdir(path.parent)
        begun, cpu = time.perf_counter(), time.process_time()
        try:
            arrows = run(path, out)
        except Exception as error:
            wrong += 1
            where = "" if isinstance(error, Wrong) else "".join(traceback.format_exc(limit=-3))
            print(f"{path.name}: {error}\n{where}", file=sys.stderr)
            continue
        took = f"{time.perf_counter() - begun:.1f} s, {time.process_time() - cpu:.1f} s of processor"
        print(f"{path.name}: {arrows} values as stated, {took}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
