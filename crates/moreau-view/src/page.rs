//! The page that plays a run, of the files in `page/`.

const HTML: &str = include_str!("../page/page.html");
const STYLE: &str = include_str!("../page/style.css");

/// The scripts, in the order of `page/ORDER`: one names what those before it have.
const SCRIPTS: [&str; 27] = [
    include_str!("../page/maths.js"),
    include_str!("../page/colour.js"),
    include_str!("../page/decoder.js"),
    include_str!("../page/data.js"),
    include_str!("../page/camera.js"),
    include_str!("../page/shaders.js"),
    include_str!("../page/shaders-more.js"),
    include_str!("../page/gl.js"),
    include_str!("../page/shapes.js"),
    include_str!("../page/scalars.js"),
    include_str!("../page/bodies.js"),
    include_str!("../page/planes.js"),
    include_str!("../page/chains.js"),
    include_str!("../page/picture.js"),
    include_str!("../page/pick.js"),
    include_str!("../page/format.js"),
    include_str!("../page/verdict.js"),
    include_str!("../page/panel.js"),
    include_str!("../page/plot.js"),
    include_str!("../page/charts.js"),
    include_str!("../page/playback.js"),
    include_str!("../page/live.js"),
    include_str!("../page/controls.js"),
    include_str!("../page/buttons.js"),
    include_str!("../page/pace.js"),
    include_str!("../page/page.js"),
    include_str!("../page/main.js"),
];

/// How long the page is without a run in it, and with room for what is around the data, bytes.
pub(crate) const SIZE: usize = {
    let (mut size, mut k) = (HTML.len() + STYLE.len() + 4096, 0);
    while k < SCRIPTS.len() {
        size += SCRIPTS[k].len();
        k += 1;
    }
    size
};

/// The page with its data in it; `meta` is safe in a script, `blocks` are in base 64.
pub(crate) fn whole(title: &str, meta: &str, blocks: &[String]) -> String {
    let mut data = format!("<script type=\"application/json\" id=\"meta\">{meta}</script>\n");
    for (k, block) in blocks.iter().enumerate() {
        data += &format!("<script type=\"application/octet-stream\" id=\"block-{k}\">{block}</script>\n");
    }
    assemble(title, &data)
}

/// The page that asks a server for its data.
pub(crate) fn served() -> String {
    assemble("moreau", "")
}

/// JSON that cannot end the script that it stands in.
pub(crate) fn script_safe(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn assemble(title: &str, data: &str) -> String {
    let (style, script) =
        (format!("<style>\n{STYLE}</style>"), format!("<script type=\"module\">\n{}</script>", SCRIPTS.join("\n")));
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let mut page = HTML.replace("<title>moreau</title>", &format!("<title>{title}</title>"));
    // The data last: what was put in is not looked through again.
    for (marker, text) in [("<!--style-->", style.as_str()), ("<!--script-->", &script), ("<!--data-->", data)] {
        page = page.replacen(marker, text, 1);
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_come_in_the_order_of_the_list() {
        let order: Vec<&str> = include_str!("../page/ORDER").split_whitespace().collect();
        assert_eq!(order.len(), SCRIPTS.len());
        for (name, script) in order.iter().zip(SCRIPTS) {
            let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("page").join(name);
            assert_eq!(std::fs::read_to_string(path).unwrap(), script, "{name}");
        }
    }
}
