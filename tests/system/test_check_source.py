"""scripts/check-source finds vague words and starts of comments in every kind of text, and leaves code alone."""

import subprocess
import unittest
from pathlib import Path

from ehlwave_program import FolderTest

WORDS = Path(__file__).parents[2]/"scripts"/"words.awk"
KINDS = "Fortran Python shell docstrings Markdown"
PLAIN = "word "*1000
FILES = {
    "a.f90": "   !> {}\n   integer :: n = 0   ! 'quoted'\n   print *, 'What ! Of it'\n",
    "b.py": '"""{}"""\n\nWHAT = "# What"\n',
    "c.py": "# {}\nwhat = 'that of'\n",
    "d.sh": "#!/usr/bin/env bash\n# {}\necho 'what of those of one'\n",
    "e.md": "{}\n\n```\nwhat those of one\n```\n\n    what\n\n| what |\n\n`what`\n",
}
VAGUE = {
    "what": "what it is",
    "that of, those of": "the film and that of the pressure",
    "say, tell": "results tell the error",
    "one, ones": "this one, that one, other ones, one",
}


class Words(FolderTest):
    def places(self, text, *names):
        """Return the lines printed for files with a text."""
        for name in names:
            self.write(name, FILES[name].replace("{}", text))
        done = subprocess.run(["awk", "-v", f"kinds={KINDS}", "-f", WORDS, *names], cwd=self.folder,
                              capture_output=True, text=True, check=True, timeout=20)
        return done.stdout.splitlines()

    def write(self, name, text):
        (Path(self.folder)/name).write_text(text)

    def test_plain_texts_pass(self):
        self.assertEqual(self.places(PLAIN, *FILES), [])

    def test_vague_words_are_counted(self):
        for name, kind in zip(FILES, ["Fortran", "docstrings", "Python", "shell", "Markdown"], strict=True):
            for word, text in VAGUE.items():
                with self.subTest(name=name, word=word):
                    found = self.places(f"{text} {PLAIN[:2000]}", name)
                    self.assertEqual(len(found), 1, found)
                    self.assertIn(f"{kind}: ", found[0])
                    self.assertIn(f"'{word}'", found[0])
                    self.assertIn(f" {name} ", found[0])

    def test_starts_are_refused(self):
        for start in ["Of", "The same", "That", "To which", "And", "What"]:
            for name in list(FILES)[:-1]:
                with self.subTest(start=start, name=name):
                    found = [place for place in self.places(f"{start} the film {PLAIN}", name) if "starts with" in place]
                    self.assertEqual(len(found), 1, found)
                    self.assertIn(f"starts with '{start}'", found[0])

    def test_continued_comments_may_start_so(self):
        self.write("a.f90", f"   integer :: n   !! the number, and the pressure\n                  !! Of Hertz {PLAIN}\n")
        done = subprocess.run(["awk", "-v", f"kinds={KINDS}", "-f", WORDS, "a.f90"], cwd=self.folder,
                              capture_output=True, text=True, check=True, timeout=20)
        self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
