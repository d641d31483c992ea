// Bytes in a page, as `build/one-file.js` writes them: two letters hold 13 bits.

/** The place of a letter among the 91 digits: those of ASCII that stand for themselves in a page, in their order. */
const digits = new Uint8Array(128);
for (let code = 33, next = 0; code < 127; code += 1) {
  if (!'"&<'.includes(String.fromCharCode(code))) digits[code] = next++;
}

/** So many bytes of such a text. */
export function unpack(text: string, count: number): Uint8Array<ArrayBuffer> {
  // What is beyond the last is not kept.
  const bytes = new Uint8Array(count);
  let [held, bits, at] = [0, 0, 0];
  for (let place = 0; place + 1 < text.length; place += 2) {
    held |= ((digits[text.charCodeAt(place)] ?? 0) + 91 * (digits[text.charCodeAt(place + 1)] ?? 0)) << bits;
    bits += 13;
    while (bits >= 8) {
      bytes[at++] = held & 255;
      held >>= 8;
      bits -= 8;
    }
  }
  return bytes;
}
