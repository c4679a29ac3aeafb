"""type_names.py notices what it is for."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("type_names.py")


class TypeNames(unittest.TestCase):
    def doubles(self, files):
        with tempfile.TemporaryDirectory() as name:
            for file, text in files.items():
                path = pathlib.Path(name, file)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            run = subprocess.run([sys.executable, "-B", str(SCRIPT), name], capture_output=True, text=True)
            self.assertEqual(run.returncode, 0 if "each one type" in run.stdout else 1, run.stderr)
            return run.stdout.splitlines()[:-1]

    def in_two(self, first, second):
        return self.doubles({"core/a/a.hpp": first, "server/b.cpp": second})

    def test_one_name_for_two_types_is_found(self):
        space = "namespace sculpt {{\n{}\n}}  // namespace sculpt\n"
        struct = space.format("struct Surface {\n  int a;\n};")
        for other in ("class Surface {\n};", "class Surface final : public Base {\n};", "enum class Surface { a, b };",
                      "struct Surface {\n};"):
            self.assertEqual(len(self.in_two(struct, space.format(other))), 1, other)

    def test_other_spaces_and_promises_may_repeat(self):
        first = "namespace sculpt {\nstruct Surface {\n};\n}  // namespace sculpt\n"
        for other in ("namespace sculpt::cli {\nstruct Surface {\n};\n}  // namespace sculpt::cli\n",
                      "namespace sculpt {\nnamespace {\nstruct Surface {\n};\n}  // namespace\n}  // namespace sculpt\n",
                      "namespace sculpt {\nstruct Surface;\n}  // namespace sculpt\n",
                      "namespace sculpt {\nclass Body {\n  struct Surface {\n  };\n};\n}  // namespace sculpt\n"):
            self.assertEqual(self.in_two(first, other), [], other)


if __name__ == "__main__":
    unittest.main()
