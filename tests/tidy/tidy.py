#!/usr/bin/env python3
"""Holds the tree to the rules of the house that no compiler checks.

usage: tidy.py CHECK [--root DIR] [--library FILE.a]...

includes   every include follows the arrows between rooms; core uses only the std headers on its
           list; GLES headers stand in platform/render alone
symbols    no core library (--library, nm -uC) needs the heap, exceptions, RTTI, GL, files, a clock
format     clang-format would change nothing
functions  no function is longer than 70 lines
lines      no line is longer than 100 columns
paths      no absolute path of one machine

Each finding is one line, FILE:LINE: what is wrong. Exit codes: 0 clean, 1 findings, 2 wrong usage,
77 the check cannot run here (a tool is missing).
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77
LONGEST_LINE = 100
LONGEST_FUNCTION = 70
# Functions that were longer when the rule came, and may only shrink: "file:name": lines.
KNOWN_LONG = {}

# Level of each room of core; a room may include itself and any room of a lower level.
CORE_LEVEL = {
    "base": 0, "pack": 1, "mesh": 2, "face": 3, "body": 3, "stream": 4, "emotion": 4, "speech": 4,
    "scene": 5, "lod": 6, "agent": 7,
}
# Standard headers without heap, exceptions and operating system; <cassert> for programmer errors;
# <string_view> for borrowed names (its members that throw show up in the symbols).
CORE_STD = set(
    "array span concepts new cstddef cstdint limits type_traits utility optional algorithm cmath "
    "cstring atomic bit cassert compare string_view arm_neon.h".split())
PLATFORM_ROOMS = set(
    "display render buttons audio voice clock watchdog thermal files control inventory log".split())
# What a folder may include beside itself.
FOLDER_ARROWS = {
    "platform": {"core"},
    "firmware-app": {"core", "platform"},
    "assets/bake": {"core"},
    "assets/fit": {"core", "assets/bake"},
    "assets/tool": {"core", "assets/bake", "assets/fit", "platform"},
    "tests": {
        "core", "platform", "firmware-app", "assets/bake", "assets/fit", "assets/tool", "tests"},
}
# Between rooms of platform: voice plays through audio, a window display has keys; every room may
# read the clock and log.
PLATFORM_ARROWS = {"voice": {"audio"}, "display": {"buttons"}}

FORBIDDEN_SYMBOL = re.compile(
    r"operator (new|delete)(\[\])?(\(.*\))?|malloc|calloc|realloc|free|aligned_alloc|"
    r"posix_memalign|__cxa_throw|__cxa_guard_\w+|typeinfo( name)? for .*|"
    r"std::__throw_\w+(\(.*\))?|gl[A-Z]\w*|open(64)?|clock_gettime")
# Spelled in parts, so that this file does not find itself.
MACHINE_PATH = re.compile("|".join("/" + name + "/" for name in ("work", "home", "root", "Users")))


def tracked(root, suffixes=None):
    """Files of the tree as git sees them (new ones too); every file where there is no git."""
    if (root / ".git").exists() and shutil.which("git"):
        names = subprocess.run(
            ["git", "-C", str(root), "-c", "safe.directory=*", "ls-files", "-co",
             "--exclude-standard"], check=True, capture_output=True, text=True).stdout.splitlines()
        files = [root / name for name in names]
    else:
        files = [f for f in root.rglob("*")
                 if not {"build", "out", ".git", "__pycache__"} & set(f.relative_to(root).parts)]
    return sorted(f for f in files if f.is_file() and (suffixes is None or f.suffix in suffixes))


def sources(root):
    return tracked(root, {".h", ".cpp", ".c"})


def text_of(path):
    return path.read_text(encoding="utf-8", errors="replace")


def folder_of(path):
    """The row of FOLDER_ARROWS, or 'core', that a path from the root belongs to."""
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] == "assets" else parts[0]


def wrong_quoted(source, target):
    """Why `source` must not include "target" (both paths from the root), or None."""
    here, there = folder_of(source), folder_of(target)
    if there not in FOLDER_ARROWS and there != "core":
        return f'"{target}" is not a path from the root of the tree'
    if here == "core":
        if there != "core":
            return f"core must not include {there}"
        own, other = source.split("/")[1], target.split("/")[1]
        if own not in CORE_LEVEL or other not in CORE_LEVEL:
            return f"core/{own if own not in CORE_LEVEL else other} is not a room of core"
        if own != other and CORE_LEVEL[other] >= CORE_LEVEL[own]:
            return f"core/{own} must not include core/{other}"
        return None
    if here != there and there not in FOLDER_ARROWS.get(here, set()):
        return f"{here} must not include {there}"
    if here == "platform" and there == "platform":
        return wrong_platform(source.split("/"), target.split("/"))
    return None


def wrong_platform(source, target):
    """platform/ROOM/BACKEND/FILE sees its room's headers and its own backend, and the clock."""
    own, other = source[1], target[1]
    if len(target) == 2 and other.removesuffix(".h") not in PLATFORM_ROOMS:
        return None  # platform/NAME.h is for every room.
    for room in (own, other):
        if room.removesuffix(".h") not in PLATFORM_ROOMS:
            return f"platform/{room} is not a room of platform"
    own, other = own.removesuffix(".h"), other.removesuffix(".h")
    arrows = PLATFORM_ARROWS.get(own, set()) | {own, "clock", "log"}
    if other not in arrows:
        return f"platform/{own} must not include platform/{other}"
    if own == other and len(source) > 3 and len(target) > 3 and source[2] != target[2]:
        return f"backend {own}/{source[2]} must not include backend {other}/{target[2]}"
    return None


def wrong_angled(source, header):
    """Why `source` must not include <header>, or None."""
    if source.startswith("core/"):
        glm = header.startswith("glm/") and source == "core/base/vec.h"
        if header not in CORE_STD and not glm:
            return f"<{header}> is not on core's list of standard headers"
    gl_header = re.match(r"(GLES\d?|GL)/", header)
    if gl_header and not source.startswith("platform/render/"):
        return f"<{header}>: GL belongs to platform/render alone"
    return None


def check_includes(root, _):
    include = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
    for path in sources(root):
        name = path.relative_to(root).as_posix()
        for number, line in enumerate(text_of(path).splitlines(), 1):
            match = include.match(line)
            if not match:
                continue
            quoted, angled = match.groups()
            why = wrong_quoted(name, quoted) if quoted else wrong_angled(name, angled)
            if why:
                yield f"{name}:{number}: {why}"


def check_symbols(_, libraries):
    for library in libraries:
        names = subprocess.run(["nm", "-uC", library], check=True, capture_output=True, text=True)
        member = library
        for line in names.stdout.splitlines():
            if line.endswith(":"):
                member = line[:-1]
            match = re.match(r"\s+[Uvw] (.*)", line)
            if match and FORBIDDEN_SYMBOL.fullmatch(match.group(1)):
                yield f"{pathlib.Path(library).name}:{member}: needs {match.group(1)}"


def check_format(root, _):
    files = [str(f) for f in sources(root)]
    if not files:
        return
    result = subprocess.run(["clang-format", "--dry-run", "-Werror", *files], cwd=root,
                            capture_output=True, text=True)
    seen = set()
    for line in result.stderr.splitlines():
        match = re.match(r"(.*?):(\d+):\d+: error: ", line)
        if match and match.group(1) not in seen:
            seen.add(match.group(1))
            name = pathlib.Path(match.group(1)).relative_to(root).as_posix()
            yield f"{name}:{match.group(2)}: run clang-format -i on it"
    if result.returncode != 0 and not seen:
        yield f"clang-format: {result.stderr.strip()}"


def blank(text):
    """The program text without comments, literals and preprocessor lines; lines stay in place."""
    def spaces(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    literal = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|'
        r"(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+'", re.S)
    text = literal.sub(spaces, text)
    return re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", spaces, text, flags=re.M)


def functions(text):
    """(first line, last line, name) of each function that stands in a namespace or a type."""
    text = blank(text)
    scopes = []  # (kind, first line, name): what each open brace is.
    head_start, line, found = 0, 1, []
    open_function = None  # A function whose member initialisers may be still going on.
    for position, sign in enumerate(text):
        if sign == "\n":
            line += 1
        elif sign == "{":
            head = text[head_start:position]
            kind = "block"
            outer = scopes[-1][0] if scopes else "namespace"
            if outer in ("namespace", "type"):
                kind = kind_of(head)
                if kind == "block" and open_function and re.match(r"\s*(,.*)?$", head, re.S):
                    kind = "function"
            name = re.search(r"([~\w:]+)\s*\(", head)
            first = line - head.lstrip().count("\n")
            if kind == "function" and open_function and not name:
                first, name_text = open_function
            else:
                name_text = name.group(1) if name else "?"
            scopes.append((kind, first, name_text))
            open_function = None
            head_start = position + 1
        elif sign == "}":
            kind, first, name = scopes.pop() if scopes else ("block", line, "?")
            if kind == "function":
                found.append((first, line, name))
                open_function = (first, name)
            head_start = position + 1
        elif sign == ";" and (not scopes or scopes[-1][0] in ("namespace", "type")):
            head_start = position + 1
            open_function = None
    return found


def kind_of(head):
    """What a brace after `head` opens, where a declaration can stand."""
    if re.search(r"\bnamespace\b", head) or re.search(r"\bextern\s*$", head):
        return "namespace"
    if re.search(r"\b(class|struct|union|enum)\b[^()]*$", head):
        return "type"
    return "function" if "(" in head and not re.search(r"=\s*$", head) else "block"


def check_functions(root, _):
    for path in sources(root):
        name = path.relative_to(root).as_posix()
        for first, last, function in functions(text_of(path)):
            length = last - first + 1
            most = max(LONGEST_FUNCTION, KNOWN_LONG.get(f"{name}:{function}", 0))
            if length > most:
                yield f"{name}:{first}: {function}() has {length} lines; at most {most}"


def check_lines(root, _):
    suffixes = {".h", ".cpp", ".c", ".py", ".sh", ".cmake", ".glsl", ".vert", ".frag"}
    for path in tracked(root):
        if path.suffix not in suffixes and path.name != "CMakeLists.txt":
            continue
        name = path.relative_to(root).as_posix()
        for number, line in enumerate(text_of(path).splitlines(), 1):
            if len(line) > LONGEST_LINE:
                yield f"{name}:{number}: {len(line)} columns; at most {LONGEST_LINE}"


def check_paths(root, _):
    for path in tracked(root):
        if b"\0" in path.read_bytes()[:4096]:
            continue
        name = path.relative_to(root).as_posix()
        for number, line in enumerate(text_of(path).splitlines(), 1):
            if MACHINE_PATH.search(line):
                yield f"{name}:{number}: a path of one machine"


CHECKS = {
    "includes": (check_includes, None), "symbols": (check_symbols, "nm"),
    "format": (check_format, "clang-format"), "functions": (check_functions, None),
    "lines": (check_lines, None), "paths": (check_paths, None),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("check", choices=sorted(CHECKS))
    parser.add_argument("--root", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--library", action="append", default=[])
    arguments = parser.parse_args()
    check, tool = CHECKS[arguments.check]
    if tool and not shutil.which(tool):
        print(f"tidy: skipped, {tool} is not installed")
        return SKIPPED
    findings = list(check(arguments.root.resolve(), arguments.library))
    for finding in findings:
        print(finding)
    print(f"tidy {arguments.check}: {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
