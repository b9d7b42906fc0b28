"""The numeric constants of the sources, and the origins that their comments state."""

import re
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
SOURCES = REPOSITORY / "Sources"
MODULES = ["Pipeline", "Kernels", "ImageFiles", "VideoFiles", "Formats", "SceneModel",
           "SceneRendering", "Evaluation", "RealityFoundation", "EngineCommands"]
KERNELS = "CKernels"
KINDS = ["measured", "paper", "limit", "chosen"]

# Definitions that no rule below recognizes: types, or members of types, with the reason.
DEFINITIONS = {
    "ColorProfile.sRGB": "the code of a color space",
    "CrateListOpBits": "bits of a mask",
    "CrateValueRep": "bits of a mask",
    "FaceObservation": "bits of a mask",
    "GLTFDocument.Sampler": "codes of OpenGL",
    "PointLabel": "labels",
    "SampleImage.all": "the content of files",
    "ScreenVertex.units": "derived from the number of bits",
    "SparseMap.noFeature": "a mark",
    "TIFFTag": "the numbers of tags",
    "VisibilityTest.corners": "the corners of a square",
    "VisibilityTest.offsets": "the neighbors of a cell",
}
# Names of definitions: neutral elements and versions of formats.
DEFINING_NAME = re.compile(r"(.*\.)?(identity|none|empty|zero|(\w*[vV]ersion|\w*Format))")
# Values that are definitions: masks, codes and magic numbers in hexadecimal digits, elements of an
# option set, multiples of the size of a type.
DEFINING_VALUE = re.compile(
    r"[\s(,]*(?:-?0[xX][\dA-Fa-f_']+[uUlL]*[\s,)]*)+|\w*\(rawValue: .*\)"
    r"|.*\bMemoryLayout<.*|.*\bsizeof\(.*")
# Tables of a format or an algorithm, such as the corners of a cube: arrays of integers, except in
# options.
TABLE = re.compile(r"[\[{][\s\[\](){},:\-\da-fA-FxX_]*")
# Numbers, and vectors and tuples of numbers.
NUMBERS = re.compile(
    r"(?:SIMD\d)?(?:<\w+>)?\(?(?:-?[\d._]+(?:e-?\d+)?(?: << \d+| \* (?:Double)?\.pi)?(?:, )?)+\)?")
# Properties that aren't options begin with nothing, or with one of something.
NEUTRAL = re.compile(r"[01](\.0)?")

BLANKED = re.compile(
    r'//[^\n]*|/\*.*?\*/|#?"""(?:.*?)"""#?|#"[^\n]*?"#|"(?:\\.|[^"\\\n])*"', re.DOTALL)
LITERAL = re.compile(
    r"(?<![\w.])(?:0[xX][\dA-Fa-f_']+|\d[\d_']*(?:\.\d[\d_']*)?(?:[eE][-+]?\d+)?)")
ORIGIN = re.compile(
    r"(?:^|(?<=[.!?:;)] ))(?:(?P<kind>Measured|Paper|Limit): (?=\S)"
    r"|(?P<chosen>Chosen)(?:\.(?= |$)|: (?=\S)))")
SWIFT_TYPE = re.compile(r"\b(?:struct|class|enum|protocol|actor|extension)\s+`?([\w.]+)")
SWIFT_CONSTANT = re.compile(
    r"[ \t]*(?:@\w+(?:\([^)]*\))?\s+)*"
    r"(?P<modifiers>(?:(?:public|package|private|fileprivate|static|lazy)(?:\(set\))?\s+)*)"
    r"(?P<keyword>let|var)\s+(?P<names>\w+|\([\w, ]+\))\s*(?::\s*[^={]+?)?\s*=\s*(?P<value>.+)",
    re.DOTALL)
# A static property of a generic type can't be stored.
SWIFT_GETTER = re.compile(
    r"[ \t]*(?P<modifiers>(?:\w+\s+)*static\s+)(?P<keyword>var)\s+(?P<names>\w+)\s*:[^{=]+"
    r"\{\s*(?P<value>-?[\d._]+(?: << \d+)?)\s*\}")
KERNEL_CONSTANT = re.compile(
    r"[ \t]*(?:(?:static|inline)\s+)*(?:constexpr|static const)\s+(?:static\s+)?"
    r"(?:unsigned\s+|const\s+)?[\w:]+(?:<[^=]*?>)?\s+(?P<rest>\w+\s*(?:\[[^=]*\]\s*)*[={].*)",
    re.DOTALL)
# A line whose comment the next line shares.
DECLARATION = re.compile(r"^[ \t]*(?:\w+ +)*(?:let|var|constexpr|static)\b.*[^{}\s]\s*$|^[ \t]*@\w")


@dataclass
class Constant:
    """A numeric constant, and its comment with a line for each paragraph."""

    path: Path
    line: int
    name: str
    value: str
    comment: str

    @property
    def origin(self):
        """The kind of the origin, and the rest of the paragraph; None without one."""
        for paragraph in self.comment.split("\n"):
            found = ORIGIN.search(paragraph)
            if found:
                kind = (found["kind"] or found["chosen"]).lower()
                return kind, paragraph[found.end():].strip()
        return None


def constants():
    """All constants, by file."""
    for module in [*MODULES, KERNELS]:
        for path in sorted((SOURCES / module).rglob("*")):
            if path.suffix in ({".h", ".cpp", ".inl"} if module == KERNELS else {".swift"}):
                yield from File(path).constants()


def is_definition(name, value):
    """Whether a value defines something rather than being one of several possible ones."""
    return (any(name == part or name.startswith(f"{part}.") for part in DEFINITIONS)
            or bool(DEFINING_NAME.fullmatch(name)) or bool(DEFINING_VALUE.fullmatch(value))
            or ("Options." not in name and bool(TABLE.fullmatch(value))))


class File:
    """A source file."""

    def __init__(self, path):
        text = path.read_text()
        self.path, self.is_swift = path, path.suffix == ".swift"
        self.lines, self.code = text.splitlines(), BLANKED.sub(blank, text).splitlines()

    def constants(self):
        scopes, index = [], 0
        while index < len(self.code):
            end = self.end_of_statement(index) if self.may_be_constant(index) else index + 1
            code = " ".join(part.strip() for part in self.code[index:end])
            if self.is_swift:
                found = SWIFT_GETTER.fullmatch(code) or SWIFT_CONSTANT.match(code)
                if found:
                    yield from self.swift(found, index, end, scopes)
            elif found := KERNEL_CONSTANT.match(code):
                yield from self.kernel(found, index, end)
            for part in self.code[index:end]:
                follow(part, scopes)
            index = end

    def may_be_constant(self, index):
        words = r"\b(?:let|var)\b.*[={]" if self.is_swift else r"\b(?:constexpr|static const)\b"
        return re.search(words, self.code[index])

    def end_of_statement(self, index):
        """The line after the statement that begins on a line."""
        depth = 0
        for end in range(index, len(self.code)):
            code = self.code[end].rstrip()
            depth += sum((letter in "([{") - (letter in ")]}") for letter in code)
            following = self.code[end + 1].strip() if end + 1 < len(self.code) else ""
            if self.is_swift:
                continues = code.endswith(("=", ",", "+", "-", "*", "/")) or following.startswith(
                    ("?", ".", "+ ", "- ", "* ", "/ "))
            else:
                continues = not code.endswith((";", "}"))
            if depth <= 0 and not continues:
                return end + 1
        return len(self.code)

    def swift(self, found, index, end, scopes):
        """The constant that a Swift declaration defines."""
        value = found["value"].strip()
        is_neutral = all(NEUTRAL.fullmatch(literal) for literal in LITERAL.findall(value))
        if "{" in value:
            return
        if scopes and not scopes[-1]:
            # In a function, most declarations are intermediate results.
            if found["keyword"] == "var" or is_neutral or not NUMBERS.fullmatch(value):
                return
        elif found["keyword"] == "var" and "static" not in found["modifiers"]:
            # Of variables, options are constants, and what callers may set.
            is_option = any(scope.split(".")[-1].endswith("Options") for scope in scopes)
            if not is_option and (not scopes or "private" in found["modifiers"] or is_neutral):
                return
        name = ".".join([*filter(None, scopes), found["names"]])
        yield from self.numeric(name, value, index, end)

    def kernel(self, found, index, end):
        """The constants that a declaration in CKernels defines."""
        for part in split(found["rest"].rstrip("; ")):
            name, operator, value = re.match(r"(\w+)[^={]*([={])?(.*)", part.strip()).groups()
            if operator:
                value = value if operator == "=" else operator + value
                yield from self.numeric(name, value.strip(), index, end)

    def numeric(self, name, value, index, end):
        if LITERAL.search(value) and not is_definition(name, value):
            yield Constant(self.path, index + 1, name, value, self.comment(index, end))

    def comment(self, index, end):
        """The comment of a declaration, or the one that it shares."""
        paragraphs, words = [], []
        above = index - 1
        while above >= 0 and DECLARATION.search(self.code[above]):
            above -= 1
        while above >= 0 and self.lines[above].strip().startswith("//"):
            text = self.lines[above].strip().lstrip("/").strip()
            if text:
                words.insert(0, text)
            else:
                paragraphs.insert(0, " ".join(words))
                words = []
            above -= 1
        # A comment at the end of a line continues on lines of its own.
        beside = [
            line[len(code.rstrip()):].strip().lstrip("/").strip()
            for line, code in zip(self.lines[index:end], self.code[index:end])]
        return "\n".join([" ".join(filter(None, beside)), " ".join(words), *paragraphs])


def follow(code, scopes):
    """Enters and leaves the scopes of a line."""
    start = 0
    for index, letter in enumerate(code):
        if letter == "{":
            found = SWIFT_TYPE.search(code[start:index])
            scopes.append(found.group(1) if found else "")
        elif letter == "}" and scopes:
            scopes.pop()
        if letter in "{}":
            start = index + 1


def split(text):
    """The parts of a text between commas that no bracket encloses."""
    depth, parts = 0, [""]
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def blank(match):
    """Blanks out a match, keeping its line breaks."""
    return "".join("\n" if letter == "\n" else " " for letter in match.group())
