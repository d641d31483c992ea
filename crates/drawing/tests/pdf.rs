//! A PDF has the page, the paths and the patterns of its SVG, and no date.

use drawing::PictureFormat;

use crate::pictures::all;

/// The bytes between two marks.
fn between<'a>(bytes: &'a [u8], from: &str, to: &str) -> Option<&'a [u8]> {
    let find = |bytes: &[u8], mark: &str| bytes.windows(mark.len()).position(|part| part == mark.as_bytes());
    let start = find(bytes, from)? + from.len();
    Some(&bytes[start..start + find(&bytes[start..], to)?])
}

/// The operators of the page.
fn content(pdf: &[u8]) -> String {
    let object = between(pdf, "\n4 0 obj", "endobj").unwrap();
    let stream = between(object, "stream\n", "\nendstream").unwrap();
    String::from_utf8(miniz_oxide::inflate::decompress_to_vec_zlib(stream).unwrap()).unwrap()
}

#[test]
fn a_pdf_is_the_same_at_every_run_and_has_no_date() {
    for (drawing, again) in all().iter().zip(all()) {
        let pdf = drawing.pdf().unwrap();
        assert_eq!(pdf, again.write_as(PictureFormat::Pdf).unwrap(), "{}", drawing.name());
        assert!(pdf.starts_with(b"%PDF-1.7\n") && pdf.ends_with(b"%%EOF"), "{}", drawing.name());
        assert!(["CreationDate", "ModDate"].iter().all(|date| between(&pdf, date, "\n").is_none()));
        // The table of objects begins at the given position.
        let start = between(&pdf, "startxref\n", "\n").unwrap();
        let start: usize = String::from_utf8(start.to_vec()).unwrap().parse().unwrap();
        assert!(pdf[start..].starts_with(b"xref\n"), "{}", drawing.name());
    }
}

/// Pages are 960 px or 10 in wide except the scatter of two panels, and every saved state is restored.
#[test]
fn a_pdf_has_a_page_of_the_size_of_the_svg() {
    for drawing in all() {
        let (pdf, svg) = (drawing.pdf().unwrap(), drawing.svg());
        let size = svg.split("viewBox=\"0 0 ").nth(1).unwrap().split('"').next().unwrap();
        let size: Vec<f64> = size.split(' ').map(|side| side.parse().unwrap()).collect();
        let page = between(&pdf, "/MediaBox [", "]").unwrap();
        let page = String::from_utf8(page.to_vec()).unwrap();
        let page: Vec<f64> = page.split(' ').map(|side| side.parse().unwrap()).collect();
        let expected = [0.0, 0.0, size[0] * 0.75, size[1] * 0.75];
        assert!(page.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{page:?} {expected:?}");
        let content = content(&pdf);
        let count = |operator: &str| content.lines().filter(|line| *line == operator).count();
        assert_eq!(count("q"), count("Q"), "{}", drawing.name());
        assert!(count("f") > 5, "{}", drawing.name());
        // Each hatched area is painted with a pattern whose name the page declares.
        let patterns = content.lines().filter(|line| line.ends_with(" scn")).count();
        assert_eq!(patterns > 0, svg.contains("fill=\"url("), "{}", drawing.name());
        for k in 0..patterns {
            assert!(between(&pdf, &format!("/P{k} "), "R").is_some(), "{}", drawing.name());
        }
    }
}

/// The lower left corner of the tornado's page is at the origin and its y runs upwards: the bar of the SVG
/// that begins at x and y is there.
#[test]
fn a_bar_is_where_the_svg_has_it() {
    let drawing = all().into_iter().find(|drawing| drawing.name() == "tornado").unwrap();
    let svg = drawing.svg();
    let number = |name: &str| crate::reader::number(&svg, "tornado-high-1", name);
    let corner = format!("{} {} m", number("x"), number("y"));
    let content = content(&drawing.pdf().unwrap());
    assert!(content.lines().any(|line| line == corner), "{corner}");
    let height: f64 =
        svg.split("viewBox=\"0 0 960 ").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    let flip = format!("0.75 0 0 -0.75 0 {} cm", height * 0.75);
    assert!(content.starts_with(&flip), "{flip}: {}", content.lines().next().unwrap());
}

/// The first curve of the windscreen. B(½) of a quadratic curve is (a + 2 b + c)/4, and of a cubic one
/// (a + 3 b + 3 c + d)/8.
#[test]
fn a_curve_goes_through_the_same_points() {
    let drawing = all().into_iter().find(|drawing| drawing.name() == "scene").unwrap();
    let front = crate::reader::attribute(&drawing.svg(), "scene-front-1", "d").unwrap();
    let numbers = |text: &str| -> Vec<f64> {
        text.split([' ', 'M', 'Q', 'L', 'Z', 'm', 'c', '\n']).filter_map(|word| word.parse().ok()).collect()
    };
    let quadratic = numbers(front.split('L').next().unwrap());
    let [ax, ay, bx, by, cx, cy] = quadratic[..] else { panic!("{front}") };
    let content = content(&drawing.pdf().unwrap());
    let start = format!("{ax} {ay} m\n");
    let curve = content.split(&start).nth(1).unwrap().split(" c\n").next().unwrap();
    let [x1, y1, x2, y2, x, y] = numbers(curve)[..] else { panic!("{curve}") };
    assert!((x - cx).abs() < 1e-3 && (y - cy).abs() < 1e-3, "{curve}");
    for (quadratic, cubic) in [
        ((ax + 2.0 * bx + cx) / 4.0, (ax + 3.0 * x1 + 3.0 * x2 + x) / 8.0),
        ((ay + 2.0 * by + cy) / 4.0, (ay + 3.0 * y1 + 3.0 * y2 + y) / 8.0),
    ] {
        assert!((quadratic - cubic).abs() < 1e-3, "{curve}");
    }
}

#[test]
fn letters_that_the_font_has_not_are_named() {
    let picture = crate::pictures::tornado(4.0);
    let named = drawing::TornadoPicture { title: "Škoda, 香川 مرحبا".to_owned(), ..picture };
    assert_eq!(named.draw().missing_letters().collect::<Vec<_>>(), ['川', '香']);
    // Each has a question mark in a PNG and a PDF; an SVG keeps it.
    let asked = drawing::TornadoPicture {
        title: "Škoda, ?? مرحبا".to_owned(),
        ..crate::pictures::tornado(4.0)
    };
    assert_eq!(named.draw().png().unwrap(), asked.draw().png().unwrap());
    assert!(named.draw().svg().contains("香川"));
    assert_eq!(asked.draw().missing_letters().count(), 0);
}

#[test]
fn a_long_title_takes_several_lines() {
    let title = "A caption of a court case ".repeat(12);
    let picture =
        drawing::TornadoPicture { title: title.trim_end().to_owned(), ..crate::pictures::tornado(4.0) };
    let svg = picture.draw().svg();
    crate::reader::Reader::new().readable("long title", &svg);
    let is_letters = |line: &&str| line.contains("font-size=\"17\"") && !line.contains("aria-hidden");
    let lines: Vec<&str> = svg.lines().filter(is_letters).collect();
    assert!(lines.len() > 2 && !svg.contains('…'), "{lines:?}");
    let words: Vec<&str> =
        lines.iter().filter_map(|line| line.split('>').nth(1)?.split('<').next()).collect();
    assert_eq!(words.join(" "), title.trim_end());
}
