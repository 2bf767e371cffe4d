#!/usr/bin/env python3
"""Shows that each check of tidy.py passes a clean tree and finds each kind of fault."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import tidy  # noqa: E402


class Tree(unittest.TestCase):
    """A scratch tree that a test writes files into."""

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def findings(self, check, libraries=()):
        return list(tidy.CHECKS[check][0](self.root, libraries))


class Includes(Tree):
    def assert_include(self, source, include, clean):
        self.write(source, f"#pragma once\n#include {include}\n")
        found = self.findings("includes")
        self.assertEqual(found == [], clean, f"{source} including {include}: {found}")
        if not clean:
            self.assertTrue(found[0].startswith(f"{source}:2: "), found)
        (self.root / source).unlink()

    def test_arrows_inside_core(self):
        self.assert_include("core/face/a.h", '"core/mesh/b.h"', True)
        self.assert_include("core/face/a.h", '"core/face/b.h"', True)
        self.assert_include("core/agent/a.h", '"core/base/b.h"', True)
        self.assert_include("core/mesh/a.h", '"core/face/b.h"', False)
        self.assert_include("core/face/a.h", '"core/body/b.h"', False)
        self.assert_include("core/speech/a.h", '"core/emotion/b.h"', False)
        self.assert_include("core/scene/a.h", '"core/lod/b.h"', False)
        self.assert_include("core/unknown/a.h", '"core/base/b.h"', False)

    def test_arrows_between_folders(self):
        self.assert_include("platform/buttons/a.h", '"core/agent/b.h"', True)
        self.assert_include("core/agent/a.h", '"platform/buttons/b.h"', False)
        self.assert_include("platform/buttons/a.h", '"assets/bake/b.h"', False)
        self.assert_include("firmware-app/a.cpp", '"platform/buttons/b.h"', True)
        self.assert_include("platform/buttons/a.h", '"firmware-app/b.h"', False)
        self.assert_include("assets/bake/a.h", '"assets/tool/b.h"', False)
        self.assert_include("assets/bake/a.h", '"assets/fit/b.h"', False)
        self.assert_include("assets/bake/a.h", '"platform/render/b.h"', False)
        self.assert_include("assets/fit/a.h", '"assets/bake/b.h"', True)
        self.assert_include("assets/tool/a.h", '"platform/render/b.h"', True)
        self.assert_include("assets/tool/a.h", '"tests/unit/b.h"', False)
        self.assert_include("tests/unit/a.cpp", '"assets/tool/b.h"', True)

    def test_rooms_of_platform(self):
        self.assert_include("platform/voice/a.h", '"platform/audio/b.h"', True)
        self.assert_include("platform/audio/a.h", '"platform/voice/b.h"', False)
        self.assert_include("platform/audio/a.h", '"platform/clock/b.h"', True)
        self.assert_include("platform/display/gbm/a.h", '"platform/display/display.h"', True)
        self.assert_include("platform/display/gbm/a.h", '"platform/display/window/b.h"', False)
        self.assert_include("platform/audio/a.h", '"platform/error_line.h"', True)
        self.assert_include("platform/misc/a.h", '"platform/misc/b.h"', False)

    def test_paths_start_at_the_root(self):
        self.assert_include("core/face/a.cpp", '"a.h"', False)
        self.assert_include("core/face/a.cpp", '"../base/b.h"', False)

    def test_standard_headers_of_core(self):
        self.assert_include("core/face/a.h", "<array>", True)
        for header in ("<vector>", "<string>", "<chrono>", "<unistd.h>", "<glm/glm.hpp>"):
            self.assert_include("core/face/a.h", header, False)
        self.assert_include("core/base/vec.h", "<glm/glm.hpp>", True)
        self.assert_include("assets/bake/a.h", "<vector>", True)

    def test_gl_stays_in_render(self):
        self.assert_include("platform/render/gles/a.h", "<GLES2/gl2.h>", True)
        self.assert_include("platform/display/gbm/a.h", "<GLES2/gl2.h>", False)
        self.assert_include("platform/display/gbm/a.h", "<EGL/egl.h>", True)


@unittest.skipUnless(shutil.which("nm"), "nm is not installed")
class Symbols(Tree):
    def library(self, text):
        self.write("a.cpp", text)
        source, out = self.root / "a.cpp", self.root / "a.o"
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, "-std=c++20", "-O1", "-c", source, "-o", out], check=True)
        return [str(out)]

    def assert_needs(self, symbol, text):
        found = self.findings("symbols", self.library(text))
        self.assertTrue(any(symbol in line for line in found), f"{symbol}: {found}")

    def test_clean(self):
        text = "#include <cmath>\n#include <cassert>\nfloat glance(float);\nvoid reopen(float);\n" \
               "void f(float x) { assert(x > 0); reopen(glance(std::sqrt(x))); }\n"
        self.assertEqual(self.findings("symbols", self.library(text)), [])

    def test_each_family(self):
        self.assert_needs("operator new", "int* f() { return new int[7]; }")
        self.assert_needs("operator delete", "void f(int* p) { delete p; }")
        self.assert_needs("std::__throw_",
                          "#include <vector>\nvoid f(std::vector<int>& v) { v.push_back(1); }")
        self.assert_needs("__cxa_throw", "void f() { throw 1; }")
        self.assert_needs("typeinfo for", "void f() { throw 1; }")
        self.assert_needs("__cxa_guard", "struct S { S(); }; S& f() { static S s; return s; }")
        self.assert_needs("needs malloc", "#include <cstdlib>\nvoid* f() { return malloc(7); }")
        self.assert_needs("needs free", "#include <cstdlib>\nvoid f(void* p) { free(p); }")
        self.assert_needs("needs open", "#include <fcntl.h>\nint f() { return open(\"a\", 0); }")
        self.assert_needs("glClear", 'extern "C" void glClear(unsigned);\nvoid f() { glClear(1); }')
        self.assert_needs("clock_gettime", "#include <time.h>\n"
                          "timespec t;\nint f() { return clock_gettime(CLOCK_MONOTONIC, &t); }")


@unittest.skipUnless(shutil.which("clang-format"), "clang-format is not installed")
class Format(Tree):
    def test_finds_unformatted_text(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("core/a.cpp", "int f() { return 1; }\n")
        self.assertEqual(self.findings("format"), [])
        self.write("core/b.cpp", "int f( ) {return 1;}\n")
        self.assertEqual(len(self.findings("format")), 1)


class Functions(Tree):
    def long_function(self, head, lines):
        return head + " {\n" + "  g();\n" * (lines - 2) + "}\n"

    def assert_long(self, head, name):
        around = ("namespace n {{\n// A {{ brace.\nint z[] = {{1, 2}};\n{}\n"
                  "struct S {{ int a = 1; }};\n}}\n")
        self.write("core/a.cpp", around.format(self.long_function(head, 70)))
        self.assertEqual(self.findings("functions"), [])
        self.write("core/a.cpp", around.format(self.long_function(head, 71)))
        self.assertEqual(self.findings("functions"),
                         [f"core/a.cpp:4: {name}() has 71 lines; at most 70"])

    def test_kinds_of_function(self):
        self.assert_long("void f()", "f")
        self.assert_long("auto f(int a) const -> int", "f")
        self.assert_long("S::S() : a_{1}, b_{'{'}", "S::S")
        self.assert_long("TEST(Suite, name)", "TEST")

    def test_long_data_is_no_function(self):
        self.write("core/a.cpp", "const char* a = R\"(\nvoid f() {\n" + "x\n" * 90 + "})\";\n" +
                   "int table[] = {\n" + "  1,\n" * 90 + "};\n")
        self.assertEqual(self.findings("functions"), [])

    def test_member_functions_count(self):
        self.write("core/a.h", "class A {\n" + self.long_function("  int f()", 80) + "};\n")
        self.assertEqual(len(self.findings("functions")), 1)


class Texts(Tree):
    def test_line_length(self):
        self.write("core/a.h", "// " + "ä" * 97 + "\n")
        self.assertEqual(self.findings("lines"), [])
        self.write("core/a.h", "// " + "a" * 98 + "\n")
        self.assertEqual(self.findings("lines"), ["core/a.h:1: 101 columns; at most 100"])

    def test_machine_paths(self):
        self.write("a.md", "see ./work or homework/x\n")
        self.assertEqual(self.findings("paths"), [])
        self.write("a.md", "first\nsee " + "/ho" + "me/somebody/x\n")
        self.assertEqual(self.findings("paths"), ["a.md:2: a path of one machine"])


if __name__ == "__main__":
    unittest.main()
