//! Checks the documentation of all corpus files as HTML and as Markdown. All links must be valid, texts must not add markup, and no
//! page may be too large.

use crate::corpus_support::{all_files, lane, File};
use crate::docs_support::{html_links, markdown_links, values};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_site::{Format, Site};

/// Number of threads that create documentation in parallel.
const THREADS: usize = 2;

/// Maximum size of an HTML page in bytes.
const MAX_PAGE: usize = 300_000;

/// Returns the number of links in both formats of a file's documentation. Returns `None` if the file has errors.
fn links(file: &File) -> Option<(usize, usize)> {
    let compilation = check(Source::new(&*file.name, file.bytes.clone()), &Options::default());
    let pages = |format| {
        let mut site = Site::new(format);
        let mut pages = site.add_compilation("file", &compilation);
        let is_usable = !pages.is_empty();
        pages.extend(site.finish());
        is_usable.then_some(pages)
    };
    let html = pages(Format::Html)?;
    for page in html.iter().filter(|page| page.path.ends_with(".html")) {
        assert_eq!(page.text.matches("<script").count(), 1, "{}: {}", file.name, page.path);
        assert!(page.text.len() <= MAX_PAGE, "{}: {} has {} bytes", file.name, page.path, page.text.len());
        assert!(values(&page.text, "href").iter().all(|link| !link.contains("//")), "{}: {}", file.name, page.path);
    }
    Some((html_links(&html), markdown_links(&pages(Format::Markdown)?)))
}

#[test]
fn every_file_has_pages() {
    let Some(files) = all_files() else { return };
    let counts = std::thread::scope(|scope| {
        let part = |start: usize| {
            let files = &files;
            scope.spawn(move || files.iter().skip(start).step_by(THREADS).map(links).collect::<Vec<_>>())
        };
        let parts: Vec<_> = (0..THREADS).map(part).collect();
        parts.into_iter().flat_map(|part| part.join().expect("valid links")).collect::<Vec<_>>()
    });
    let (html, markdown) =
        counts.iter().flatten().fold((0, 0), |(html, markdown), count| (html + count.0, markdown + count.1));
    println!("{} files, {html} links in HTML, {markdown} in Markdown", counts.iter().flatten().count());
    // The compiler rejects up to 5 % of the corpus files, or up to 25 % of the files in the sample. Other tests cover the rejected
    // files.
    let percent = if lane::is_full() { 95 } else { 75 };
    assert!(counts.iter().flatten().count() * 100 > files.len() * percent);
}
