# SPDX-License-Identifier: BSD-3-Clause
"""The prose of a program's file: comments of headers and message types, docstrings and literals, each of at least SHORTEST words.

Adjacent literals are one text. An expression between two literals, joined by + or <<, counts as one word, as does a placeholder. Comments of other files are left out."""
import pathlib
import re

SHORTEST = 4
TOKEN = re.compile(r'''(?P<raw>R"(?P<mark>\w*)\(.*?\)(?P=mark)")|(?P<comment>//[^\n]*|/\*.*?\*/)|'(?:[^'\\\n]|\\.){1,4}'|"(?P<text>(?:[^"\\\n]|\\.)*)"''',
                   re.DOTALL)
PYTHON = re.compile(r'''#[^\n]*|(?P<raw>[fr]*"""(?P<doc>.*?)""")|[frb]*(?:'(?P<single>(?:[^'\\\n]|\\.)*)'|"(?P<text>(?:[^"\\\n]|\\.)*)")''', re.DOTALL)
SHELL = re.compile(r'''(?:^|\s)#[^\n]*|'[^']*'|"(?P<text>(?:[^"\\]|\\.)*)"''')
BETWEEN = re.compile(r'\s*|\s*(?:\+|<<)[^;"{}?]{1,80}(?:\+|<<)\s*')
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include.*$', re.MULTILINE)


def comments(text):
    """Yields (line, text) of each paragraph: consecutive comment lines, split at an empty or indented line (a formula) or a bullet."""
    block, last, beside = [], -1, False
    for token in TOKEN.finditer(text):
        if not token['comment']:
            continue
        line = text[:token.start()].count('\n') + 1
        begin = bool(text[text.rfind('\n', 0, token.start()) + 1:token.start()].strip())  # code stands before the comment
        for number, raw in enumerate(token['comment'].splitlines(), line):
            said = re.sub(r'^\s*(?:/\*+|///?<?|\*(?!/))|\*/\s*$', '', raw)
            formula = bool(re.match(r'\s{2,}\S', said))
            item = re.match(r'\s*(?:[-*]|\d+[.)])\s', said)
            new = begin or beside and not raw.lstrip().startswith('///<')  # the comment of another member
            if block and (number != last + 1 or not said.strip() or formula or item or new):
                yield block[0][0], '\n'.join(part for _, part in block)
                block = []
            last = number
            if said.strip() and not formula and not re.match(r'\s*(?:NOLINT|clang-format|SPDX)', said):
                block.append((number, said.strip()))
            begin, beside = False, begin or beside and not new
    if block:
        yield block[0][0], '\n'.join(part for _, part in block)


def unescaped(literal):
    literal = re.sub(r'\\["\']', "'", literal.replace('\\n', '\n').replace('\\t', ' '))
    return re.sub(r'\$?\{[^{}]*\}|\$\(.*?\)|%[-\d.]*[a-z](?!\w)', 'X', literal)


def literals(text, pattern):
    """Yields (line, text) of each literal, with adjacent literals joined."""
    joined, begin, end = None, 0, 0
    for token in pattern.finditer(text):
        groups = token.groupdict()
        said = next((groups[name] for name in ('doc', 'single', 'text') if groups.get(name) is not None), None)
        if said is None:
            continue
        between = text[end:token.start()]
        if joined is not None and not groups.get('doc') and BETWEEN.fullmatch(between):
            joined += (' X ' if between.strip() and pattern is not SHELL else '') + unescaped(said)
        else:
            if joined:
                yield begin, joined
            joined, begin = unescaped(said), text[:token.start()].count('\n') + 1
        end = token.end()
    if joined:
        yield begin, joined


def texts(path):
    """Yields (line, text) of each paragraph of prose in the file."""
    text = INCLUDE.sub('', pathlib.Path(path).read_text(encoding='utf-8'))
    suffix = pathlib.Path(path).suffix
    if suffix in ('.h', '.lcm'):
        yield from ((line, said) for line, said in comments(text) if len(said.split()) >= SHORTEST)
    if suffix == '.lcm':
        return
    python = suffix == '.py' or text.startswith('#!/usr/bin/env python')
    pattern = TOKEN if suffix in ('.h', '.cc') else PYTHON if python else SHELL
    for line, literal in literals(text, pattern):
        # In Python an empty line or an argument, "name: meaning", ends a paragraph.
        for part in re.finditer(r'(?:[^\n]|\n(?!\s*\n|\s*[\w(), ]{1,20}: ))+' if python else r'[^\n]+', literal):
            if len(part[0].split()) >= SHORTEST:
                yield line + (literal[:part.start()].count('\n') if python else 0), part[0]
