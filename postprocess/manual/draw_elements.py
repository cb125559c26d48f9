"""Draw the pictures of machine elements that pages of the manual show.

python postprocess/manual/draw_elements.py
"""

from pathlib import Path

from ehlwave.elements.drawing import DRAWINGS, drawing_svg
from ehlwave.writing import Writer

FOLDER = Path(__file__).parent / "elements"


def main(folder: Path = FOLDER) -> None:
    """Write a picture of each element."""
    writer = Writer(overwrite=True)
    for name in DRAWINGS:
        writer.text(folder / f"{name}.svg", drawing_svg(name) + "\n")


if __name__ == "__main__":
    main()
