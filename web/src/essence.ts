// What the answer of a case depends on: its text without comments, white space, title, source and [report].

/** A text in quotes, a comment, white space, or what is none of them. */
const PIECES = /"""[\s\S]*?"""|'''[\s\S]*?'''|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'|#[^\n]*|\n|[ \t\r]+|[^"'#\s]+|["']/g;

/** Each line of the file with its comments left out; a text of several lines is part of the line in which it begins. */
function* lines(text: string): Generator<string> {
  let line = "";
  for (const [piece] of text.matchAll(PIECES)) {
    if (piece === "\n") {
      yield line.trim();
      line = "";
    } else if (/^[ \t\r]/.test(piece)) line += " ";
    else if (!piece.startsWith("#")) line += piece;
  }
  yield line.trim();
}

export function essence(text: string): string {
  let table = "";
  const kept: string[] = [];
  for (const line of lines(text)) {
    table = /^\[+ ?([^\]]+?) ?\]+$/.exec(line)?.[1] ?? table;
    const isOfReport = /^report\b/.test(table) || (table === "" && /^(?:title|source|report) ?[=.]/.test(line));
    if (line !== "" && !isOfReport) kept.push(line);
  }
  return kept.join("\n");
}
