#!/usr/bin/env python3
"""The check of includes finds what is wrong with a house, and says where."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import includes  # noqa: E402

PICTURE = """## Folders and rooms

```text
                  the filter
mcl            -> container
                  the container
container/core -> base
container/base ->
```
"""


class Includes(unittest.TestCase):
    def problems(self, picture=PICTURE, **files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            files = {"container/base/include/ortung/base/A.hpp": "#include <vector>\n", **{
                name.replace("__", "/"): text for name, text in files.items()}}
            files["docs/architecture.md"] = picture
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            includes.BIGGEST_SHARE = 1.0
            return includes.check(root)

    def test_a_house_in_order_has_no_problems(self):
        self.assertEqual(self.problems(**{"mcl/src/B.cpp": '#include "ortung/base/A.hpp"\n#include <Eigen/Core>\n'}), [])

    def test_arrows_point_downwards(self):
        files = {"mcl/include/ortung/mcl/M.hpp": "", "container/core/src/C.cpp": '  #  include "ortung/mcl/M.hpp"\n'}
        self.assertRegex(self.problems(**files)[0], "C.cpp includes ortung/mcl/M.hpp of mcl, which container/core may not")

    def test_private_headers_are_of_their_rooms(self):
        files = {"mcl/src/P.hpp": "", "container/core/src/C.cpp": '#include "P.hpp"\n'}
        self.assertRegex(self.problems(**files)[0], "C.cpp includes P.hpp of mcl")

    def test_a_new_folder_is_refused(self):
        self.assertEqual(self.problems(**{"sim/src/S.cpp": "\n"}),
                         ["sim/src/S.cpp lies in no room of docs/architecture.md"])

    def test_the_picture_itself_has_no_arrow_up_and_no_unknown_room(self):
        upwards = PICTURE.replace("container/base ->", "container/base -> core attic")
        self.assertEqual(len(self.problems(upwards)), 2)

    def test_libraries_of_others_stay_where_they_are(self):
        found = self.problems(**{"mcl/src/B.cpp": "#include <mrpt/obs/X.h>\n#include <strange/y.hpp>\n"})
        self.assertRegex(found[0], "must not include <mrpt/obs/X.h>")
        self.assertRegex(found[1], "does not know")

    def test_no_room_holds_too_much(self):
        share, whole = includes.BIGGEST_SHARE, includes.check
        try:
            with tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder)
                (root / "docs").mkdir()
                (root / "docs/architecture.md").write_text(PICTURE)
                (root / "mcl").mkdir()
                (root / "mcl/a.cpp").write_text("\n" * 10)
                includes.BIGGEST_SHARE = 0.2
                self.assertRegex(whole(root)[0], "mcl holds 100 % of the code")
        finally:
            includes.BIGGEST_SHARE = share


if __name__ == "__main__":
    unittest.main()
