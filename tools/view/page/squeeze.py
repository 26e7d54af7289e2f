# SPDX-License-Identifier: BSD-3-Clause
"""Scripts and style sheets without what only readers need: comments, indentation, spaces beside punctuation.

Line ends stay, so that the browser's messages name lines, and so that no statement depends on where one ends.
"""

import itertools
import re

# Where the text before it ends like this, a slash begins a regular expression and no division.
BEFORE_EXPRESSION = re.compile(r"(^|[(,=:\[!&|?{};+\-*%~<>^]|\b(return|typeof|case|in|of|void|delete|throw))\s*$")
QUOTED = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'', re.DOTALL)
EXPRESSION = re.compile(r"/(?![*/])(?:[^/\\\[\n]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/[a-z]*")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
SPACES = re.compile(r"[ \t]+")
SIGNS = "+-/"
NO_SPACE_BESIDE = "=<>?:,;{}()&|!*%[]"


def template_end(text, at):
    """The end of the template that begins at `at`; code within it may have templates of its own."""
    at += 1
    while text[at] != "`":
        if text[at] == "\\":
            at += 2
        elif text.startswith("${", at):
            at, depth = at + 2, 1
            while depth > 0:
                if text[at] == "`":
                    at = template_end(text, at)
                    continue
                depth += {"{": 1, "}": -1}.get(text[at], 0)
                at += 1
        else:
            at += 1
    return at + 1


def pieces(text):
    """Literals, which stay as they are, and single characters; comments are left out, spaces are one each."""
    at, before = 0, ""
    while at < len(text):
        match = None
        if text[at] == "`":
            end, literal = template_end(text, at), True
        elif match := COMMENT.match(text, at):
            at = match.end()
            continue
        elif match := QUOTED.match(text, at):
            end, literal = match.end(), True
        elif text[at] == "/" and BEFORE_EXPRESSION.search(before) and (match := EXPRESSION.match(text, at)):
            end, literal = match.end(), True
        elif match := SPACES.match(text, at):
            end, literal = match.end(), False
        else:
            end, literal = at + 1, False
        piece = text[at:end] if literal or match is None else " "
        yield piece
        before = (before + piece)[-40:]
        at = end


def squeeze_script(text):
    kept = []
    for piece in pieces(text):
        last = kept[-1][-1] if kept else "\n"
        if piece == "\n":
            if kept and kept[-1] == " ":
                kept.pop()
            # Where a statement cannot end, a line need not.
            if not kept or kept[-1][-1] in "\n{;,([":
                continue
        elif piece == " ":
            if last in NO_SPACE_BESIDE + "\n":
                continue
        else:
            if kept and kept[-1] == " " and (piece[0] in NO_SPACE_BESIDE or joins(kept[-2][-1], piece[0])):
                kept.pop()
            # Nor does one end before what only goes on.
            if kept and kept[-1] == "\n" and piece[0] in ")]}.?:&|=,;":
                kept.pop()
        kept.append(piece)
    return "".join(squeeze_code(part) if code else "".join(part) for code, part in runs(kept))


def joins(one, other):
    """Whether a space between a sign and another character can go; two signs must not become one operator."""
    return (one in SIGNS) != (other in SIGNS)


def runs(kept):
    """Code and literals in turn, as lists of pieces."""
    for code, part in itertools.groupby(kept, lambda piece: len(piece) == 1):
        yield code, list(part)


def squeeze_code(part):
    """Shorter words for the same: no parentheses about a function's only parameter, nothing needless before the end of a block.

    Constants become variables: that nothing assigns to them has been seen by then, by the tests on the sources. Sources end
    statements with semicolons, so that after a brace a line need not end; the begins of functions still begin lines.
    """
    text = re.sub(r"(?<![\w$)\]])\((\w+)\)=>", r"\1=>", "".join(part))
    text = re.sub(r"(?<![.\w$])const(?=[\s\[{])", "let", text)
    text = re.sub(r"(?<![.\w$])(true|false)(?![\w$])", lambda word: "!0" if word[1] == "true" else "!1", text)
    return re.sub(r"}\n(?!class |function |async )", "}", re.sub(r";+(?=})|,(?=[}\])])", "", text))


def squeeze_style(text):
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r"\s*([{};,])\s*", r"\1", text)
    return re.sub(r": +", ":", text).replace(";}", "}").replace("}", "}\n")


def squeeze_page(text):
    return re.sub(r"^\s+", "", text, flags=re.MULTILINE)
