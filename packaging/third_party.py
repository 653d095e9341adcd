#!/usr/bin/env python3
"""Prints the licences of all crates and fonts that are part of the program or of the Python wheel.

    packaging/third_party.py > packaging/THIRD-PARTY

Reads the licence files in Cargo's copy of each crate (`cargo fetch` brings them), of all platforms. Of licences that are
joined by OR, it takes the first of `PREFERRED`. Identical texts are printed once, with the copyright notices of their crates.
`tests/packages.rs` compares the listed crates with Cargo.lock.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAMS = {"svbrdf", "svbrdf-python"}

# The licences that `.cargo/deny.toml` allows, the preferred ones first; each with words that only its text has.
PREFERRED = {
    "MIT": "Permission is hereby granted, free of charge, to any person obtaining a copy of this software",
    "Apache-2.0": "Apache License Version 2.0",
    "BSD-2-Clause": "Redistribution and use in source and binary forms",
    "BSD-3-Clause": "Neither the name",
    "Zlib": "This software is provided 'as-is', without any express or implied",
    "ISC": "Permission to use, copy, modify, and/or distribute this software",
    "BSL-1.0": "Boost Software License",
    "0BSD": "Permission to use, copy, modify, and/or distribute this software for any purpose",
    "Unlicense": "This is free and unencumbered software",
    "Unicode-3.0": "UNICODE LICENSE V3",
}
# Of fonts, whose texts are printed as they are.
FONT_LICENCES = {"OFL-1.1", "Ubuntu-font-1.0"}
# Of fonts whose crates do not say it: the crate, and the licence of the font within.
FONTS_WITHIN = {"egui_material_icons": ("Material Symbols Rounded, by Google", "Apache-2.0")}
LICENCE_FILE = re.compile(r"(licen[cs]e|copying|copyright|notice|unlicense)", re.IGNORECASE)
COPYRIGHT = re.compile(r"^\W*(copyright\b.*(\d{4}|\bby\b|\(c\)|©).*|©.*)$", re.IGNORECASE)


def chosen(expression: str) -> list[str]:
    """The identifiers of an SPDX expression that apply: all of AND, the preferred one of OR."""
    tokens = re.findall(r"\(|\)|[\w.+-]+", expression.replace("/", " OR "))

    def term() -> list[str]:
        token = tokens.pop(0)
        if token != "(":
            if tokens[:1] == ["WITH"]:
                del tokens[:2]
            return [token]
        inner = any_of()
        tokens.pop(0)
        return inner

    def all_of() -> list[str]:
        found = term()
        while tokens[:1] == ["AND"]:
            tokens.pop(0)
            found += term()
        return found

    def any_of() -> list[str]:
        choices = [all_of()]
        while tokens[:1] == ["OR"]:
            tokens.pop(0)
            choices.append(all_of())
        order = [*PREFERRED, *FONT_LICENCES]
        return min(choices, key=lambda ids: max(order.index(i) if i in order else len(order) for i in ids))

    return any_of()


def words(text: str) -> str:
    """A text without the differences that do not matter: spaces, line breaks and marks of comments."""
    return " ".join(re.sub(r"[^\w.,;:'\"()/-]+", " ", text).split())


def crates() -> dict[tuple[str, str], dict]:
    """The crates that the program or the wheel is built from, with what Cargo knows of each."""
    command = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", str(ROOT / "Cargo.toml")]
    metadata = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    packages = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    waiting = [identifier for identifier, package in packages.items() if package["name"] in PROGRAMS]
    done = set()
    while waiting:
        identifier = waiting.pop()
        if identifier in done:
            continue
        done.add(identifier)
        for dependency in nodes[identifier]["deps"]:
            if any(kind["kind"] != "dev" for kind in dependency["dep_kinds"]):
                waiting.append(dependency["pkg"])
    of_others = (packages[identifier] for identifier in done if packages[identifier]["source"])
    found = {(package["name"], package["version"]): package for package in of_others}
    return dict(sorted(found.items()))


def licence_files(package: dict) -> list[str]:
    """The texts of the licence files in the folder of a crate."""
    folder = pathlib.Path(package["manifest_path"]).parent
    paths = [path for path in folder.iterdir() if LICENCE_FILE.match(path.name)]
    paths += [path for directory in paths if directory.is_dir() for path in directory.iterdir()]
    return [path.read_text(errors="replace") for path in sorted(paths) if path.is_file()]


def main() -> None:
    bodies: dict[str, collections.Counter] = collections.defaultdict(collections.Counter)
    texts: dict[tuple[str, str], str] = {}
    users: dict[tuple[str, str], list] = collections.defaultdict(list)
    without = []
    fonts: list[dict] = []
    table = []
    for (name, version), package in crates().items():
        expression = package["license"] or sys.exit(f"{name} {version} states no licence")
        table.append(f"{name} {version}: {expression}")
        if name in FONTS_WITHIN:
            font, licence = FONTS_WITHIN[name]
            without.append((licence, font, f"(in {name} {version})", []))
        files = licence_files(package)
        notices = [text for text in files if not any(words(mark) in words(text) for mark in PREFERRED.values())]
        for identifier in chosen(expression):
            if identifier in FONT_LICENCES:
                fonts.append(package)
                continue
            if identifier not in PREFERRED:
                sys.exit(f"{name} {version}: {identifier} is not among the licences that are allowed")
            mark = words(PREFERRED[identifier])
            text = next((text for text in files if mark.lower() in words(text).lower()), None)
            if text is None:
                without.append((identifier, name, version, package["authors"]))
                continue
            lines = text.strip("\n\ufeff").splitlines()
            is_notice = [bool(COPYRIGHT.match(line)) and identifier != "Apache-2.0" for line in lines]
            rights = [line.strip(" *#/") for line, notice in zip(lines, is_notice) if notice]
            body = "\n".join(line.rstrip() for line, notice in zip(lines, is_notice) if not notice).strip()
            key = (identifier, words(body).lower())
            texts.setdefault(key, body)
            bodies[identifier][key] += 1
            extra = [line for notice in notices for line in notice.strip().splitlines()] if identifier == "Apache-2.0" else []
            users[key].append((f"{name} {version}", rights + extra))
    for identifier, name, version, authors in without:
        if not bodies[identifier]:
            sys.exit(f"{name} {version}: no crate has the text of {identifier}")
        key = bodies[identifier].most_common(1)[0][0]
        rights = [f"by {', '.join(authors)}"] if authors else [] if ", by " in name else [f"by the authors of {name}"]
        users[key].append((f"{name} {version}", rights))
    show(table, texts, users)
    for package in {package["name"]: package for package in fonts}.values():
        show_fonts(package)


def show_fonts(package: dict) -> None:
    """Prints the names of the fonts of a crate, and the texts beside them."""
    files = sorted((pathlib.Path(package["manifest_path"]).parent / "fonts").iterdir())
    names = [file.name for file in files if file.suffix == ".ttf"]
    print(f"\n{'=' * 80}\nFonts of {package['name']} {package['version']}: {', '.join(names)}")
    for file in files:
        if file.suffix == ".txt":
            print(f"\n{'-' * 80}\n{file.name}\n\n{file.read_text(errors='replace').strip()}")


def show(table: list[str], texts: dict, users: dict) -> None:
    """Prints the table of crates, then each text with its crates."""
    print("Crates and fonts of others that are part of svbrdf, on any platform, and their licences.")
    print("Made by packaging/third_party.py. svbrdf itself: MIT OR Apache-2.0.\n")
    print("\n".join(table))
    for key in sorted(users, key=lambda key: (list(PREFERRED).index(key[0]), -len(users[key]), key)):
        identifier = key[0]
        print(f"\n{'=' * 80}\n{identifier}, for:\n")
        for name, rights in sorted(users[key]):
            print(f"  {name}")
            for line in dict.fromkeys(rights):
                print(f"      {line}" if line else "")
        print(f"\n{texts[key]}")


if __name__ == "__main__":
    main()
