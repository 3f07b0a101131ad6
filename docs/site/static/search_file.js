// Sphinx fetches each page that it found, for its summary. A browser refuses that if the site was opened as a file.
if (location.protocol === "file:") {
  const texts = new Promise((resolve) => {
    const script = document.createElement("script");
    script.src = "_static/page_texts.js";
    script.onload = () => resolve(PAGE_TEXTS);
    document.head.append(script);
  });
  window.fetch = async (url) => new Response((await texts)[url.replace(/^\.\//, "")]);
}
