# SPDX-License-Identifier: MIT
"""named_options.py SOURCE_FOLDER PROGRAM…: checks that each option named in a message of the
sources exists in the program that prints the message. A text in the folder of one program belongs
to that program; a shared text may name only options that all programs printing it have. Programs
are ph-barcode, ph-segment and others."""
import os
import re
import sys

from run_corpus import named_options, options_of

# Sources that read inputs of ph-segment, in addition to the folders core/, metric/ and complex/.
READERS_OF_CLOUDS = re.compile(
    r"io/(clouds/|images/png|tables/text_lines|bytes/(input|unpack|lzf|binary_cursor|output_file))")
# Sources that read inputs only for ph-segment.
DEPTH_AND_ARRAYS = re.compile(r"io/clouds/(depth|npy_cloud|camera)")
STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')


# A row of this table applies only to programs that have its option, which its own test checks.
FOREIGN = "apps/common/arguments/foreign_options.cpp"


def texts_of(path):
    """The string literals of a file outside comments, each with its line."""
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if line.lstrip().startswith(("//", "#include")):
                continue
            for text in STRING.findall(line):
                yield number, text


def sources(folder):
    for base, _, names in os.walk(folder):
        for name in sorted(names):
            if name.endswith((".cpp", ".hpp", ".ipp")):
                yield os.path.join(base, name)


def programs_of(path):
    """The programs that print the texts of a source file."""
    own = re.match(r"apps/(barcode|vectorise|distance|cluster)/", path)
    if own:
        return ("ph-" + own[1],)
    if path.startswith(("apps/segment/", "libsegment/")) or DEPTH_AND_ARRAYS.search(path):
        return ("ph-segment",)
    if path.startswith("libph/") and not READERS_OF_CLOUDS.search(path) and "/io/" in path:
        return ("ph-barcode",)
    if path.startswith("apps/common/distances/"):
        return ("ph-distance",)
    if re.match(r"apps/common/inputs/(set_options|read_data)", path):  # of points and distances
        return ("ph-barcode", "ph-cluster")
    # Code that draws pictures names options for pictures.
    if path.startswith("apps/common/") and "plot" not in path:
        return ("ph-barcode", "ph-segment", "ph-vectorise", "ph-distance", "ph-cluster")
    return ("ph-barcode", "ph-segment")


def main():
    root, *programs = sys.argv[1:]
    options = {os.path.basename(program): options_of(program) for program in programs}
    os.chdir(root)
    looked_at = faults = 0
    for folder in ("apps", "libph", "libsegment"):
        for path in sources(folder):
            if path == FOREIGN:
                continue
            for number, text in texts_of(path):
                for option in named_options(text):
                    looked_at += 1
                    for program in programs_of(path):
                        if option not in options[program]:
                            faults += 1
                            print(f"{path}:{number}: {option}: {program} has no such option")
    print(f"{looked_at} options named in messages, {faults} that are not there")
    sys.exit(1 if faults or looked_at < 100 else 0)


if __name__ == "__main__":
    main()
