"""Checks the dataset of a haptic user study, or writes its report."""

from __future__ import annotations

import argparse
import sys
from typing import List, Optional

from .check import check
from .load import StudyError, load
from .report import write_report
from .statistics import Options


def main(arguments: Optional[List[str]] = None) -> int:
    """Runs the command; gives its exit status, 1 where the dataset is wrong."""
    parser = argparse.ArgumentParser(prog="python -m asperity.study", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    checking = commands.add_parser("check", help="whether a dataset follows Psych-DS")
    reporting = commands.add_parser("report", help="one page of HTML with all results")
    for command in (checking, reporting):
        command.add_argument("dir", metavar="DIR", help="the dataset's folder")
    add, default = reporting.add_argument, "; default: %(default)s"
    add("-o", "--output", default="report.html", help="the page" + default)
    add("--guard", type=float, default=10.0, help="points by which anchors must differ" + default)
    add("--seed", type=int, default=1, help="of the bootstraps" + default)
    given = parser.parse_args(arguments)
    try:
        if given.command == "report":
            options = Options(guard=given.guard, seed=given.seed)
            write_report(load(given.dir), given.output, options)
            return 0
        found = check(given.dir)
        errors = sum(finding.is_error for finding in found)
        print(*found, f"{errors} errors, {len(found) - errors} warnings", sep="\n")
        return int(errors > 0)
    except (StudyError, ImportError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
