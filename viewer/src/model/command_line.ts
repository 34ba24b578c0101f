// SPDX-License-Identifier: MIT
// The command line that reproduces what is on the screen.
import { exact } from "../common/number_format";
import type { Session } from "./session";

/// A word quoted for a POSIX shell.
function quoted(word: string): string {
  return /^[A-Za-z0-9_@%+=:,./-]+$/.test(word) ? word : `'${word.replace(/'/g, `'\\''`)}'`;
}

/// The command line that wrote the report; at another cut, the command line that makes this cut.
export function commandLine(session: Session): string {
  const { tree, provenance } = session.report.meta;
  const words =
    tree?.command && session.cutValue !== tree.cut
      ? tree.command.map((word) => word.replaceAll("{cut}", exact(session.cutValue)))
      : (provenance.command ?? []);
  return words.map(quoted).join(" ");
}
