#!/usr/bin/env python3
"""Makes font_data.cpp, the font of pictures: a subset of DejaVu Sans without hinting, as base64.

    apt-get download fonts-dejavu-core && dpkg-deb -x fonts-dejavu-core_*.deb .     # 2.37
    pip install fonttools
    make_font.py usr/share/fonts/truetype/dejavu/DejaVuSans.ttf > font_data.cpp

The same font and the same fonttools give the same file.
"""

import base64
import io
import sys

from fontTools import subset, version
from fontTools.ttLib import TTFont

# What names, units and numbers are written with. A letter that is not here is drawn as a box; `render --font` takes
# another font.
RANGES = (
    (0x20, 0x7E),  # ASCII
    (0xA0, 0x17F),  # Latin of western, northern and eastern Europe, Turkish
    (0x218, 0x21B),  # Romanian
    (0x384, 0x3CE),  # Greek
    (0x401, 0x45F),  # Cyrillic
    (0x1E9E, 0x1E9E),
    (0x2010, 0x2015),  # hyphens and dashes
    (0x2018, 0x201E),  # quotation marks
    (0x2020, 0x2022),
    (0x2026, 0x2026),
    (0x2030, 0x2033),  # per mille, primes
    (0x2070, 0x208E),  # superscripts, subscripts
    (0x20AC, 0x20AC),
    (0x2190, 0x2195),  # arrows
    (0x2202, 0x2202),
    (0x2205, 0x2207),
    (0x220F, 0x2212),
    (0x221A, 0x221E),
    (0x222B, 0x222B),
    (0x2248, 0x2248),
    (0x2260, 0x2265),
)
LINE = 112


def smaller(font_file):
    """The bytes of the subset, and how many characters it has."""
    options = subset.Options()
    options.hinting = False
    options.layout_features = ["kern"]
    options.name_IDs = [0, 1, 13]  # copyright, name, licence
    options.name_languages = [0x409]
    options.notdef_outline = True
    options.recalc_timestamp = False
    options.drop_tables += ["GSUB", "GDEF", "FFTM", "MATH"]
    font = TTFont(font_file)
    wanted = {code for first, last in RANGES for code in range(first, last + 1)}
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=wanted)
    subsetter.subset(font)
    for record in list(font["name"].names):  # the licence travels with the font; one byte a character is enough
        font["name"].removeNames(record.nameID, record.platformID)
        font["name"].setName(record.toUnicode(), record.nameID, 1, 0, 0)
    out = io.BytesIO()
    font.save(out)
    return out.getvalue(), len(font.getBestCmap())


def main():
    data, characters = smaller(sys.argv[1])
    text = base64.b64encode(data).decode()
    print(f"""\
// Made by make_font.py (fonttools {version}) out of DejaVu Sans 2.37: {characters} characters, {len(data)} bytes.
// DejaVu's licence is in LICENSE beside this file.
#include <brushfire/figure/detail/font_data.h>

namespace brushfire::detail {{
namespace {{

// clang-format off
constexpr std::string_view kLines[] = {{""")
    for start in range(0, len(text), LINE):
        print(f'  "{text[start : start + LINE]}",')
    print("""\
};
// clang-format on

}  // namespace

std::span<const std::string_view> font_in_base64() { return kLines; }

}  // namespace brushfire::detail""")


main()
