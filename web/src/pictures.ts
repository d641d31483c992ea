// Drawings: shown on a sheet, and saved as SVG or PNG.
import { download, h, markup } from "./dom.js";
import { texts } from "./texts/en.js";

const words = texts.pictures;

/** The width of a PNG, in pixels: enough for a page of paper. */
const PIXELS = 2400;

/** A drawing as a PNG, painted by the browser. */
export async function png(svg: string): Promise<Blob> {
  const [, , width = 960, height = 720] = (/viewBox="([^"]+)"/.exec(svg)?.[1] ?? "").split(" ").map(Number);
  const sized = svg.replace("<svg ", `<svg width="${width}" height="${height}" `);
  const url = URL.createObjectURL(new Blob([sized], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = h("canvas", { width: PIXELS, height: Math.round((PIXELS * height) / width) });
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, failed) =>
      canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("no picture"))), "image/png"),
    );
  } finally {
    URL.revokeObjectURL(url);
  }
}

/** Two buttons that save a drawing. */
export function saveButtons(name: string, title: string, svg: () => string | null): HTMLElement {
  const save = async (kind: "svg" | "png") => {
    const drawing = svg();
    if (drawing === null) return;
    if (kind === "svg") download(`${name}.svg`, drawing, "image/svg+xml");
    else download(`${name}.png`, await png(drawing), "image/png");
  };
  const button = (kind: "svg" | "png", label: string) =>
    h("button", { type: "button", class: "quiet", "aria-label": `${label}: ${title}`, onclick: () => void save(kind) }, label);
  return h("div", { class: "save-buttons" }, button("svg", words.svg), button("png", words.png));
}

/** A drawing with its title and its buttons. */
export function figure(name: string, title: string, svg: string): HTMLElement {
  const sheet = h("div", { class: "sheet" });
  markup(sheet, svg);
  return h("figure", { class: "drawing" }, sheet, h("figcaption", {}, h("span", {}, title), saveButtons(name, title, () => svg)));
}
