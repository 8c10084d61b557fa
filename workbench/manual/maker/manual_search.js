// Sections that hold every word typed; a word in a title counts more, what was or was measured less.
// `sections` stands above.
const query = document.getElementById("query");
const hits = document.getElementById("hits");

function score(section, words) {
  const [address, page, title, text] = section.map((part) => part.toLowerCase());
  let sum = 0;
  for (const word of words) {
    const found = text.split(word).length - 1;
    const named = (title === word ? 40 : title.includes(word) ? 8 : 0) + (page.includes(word) ? 4 : 0);
    if (found + named === 0) return 0;
    sum += named + Math.min(found, 5);
  }
  return /^(history|validation)[.]html/.test(address) ? 0.1 * sum : sum;
}

function excerpt(text, word) {
  const at = Math.max(0, text.toLowerCase().indexOf(word) - 60);
  return (at > 0 ? "… " : "") + text.slice(at, at + 180).trim() + " …";
}

function show() {
  const words = query.value.toLowerCase().split(/\s+/).filter((word) => word.length > 1);
  hits.replaceChildren();
  if (words.length === 0) {
    if (query.value.trim()) hits.append("Two letters or more are needed.");
    return;
  }
  const found = sections
    .map((section) => ({section, value: score(section, words)}))
    .filter((hit) => hit.value > 0)
    .sort((a, b) => b.value - a.value)
    .slice(0, 20);
  if (found.length === 0) hits.append("Nothing found; try fewer or shorter words.");
  for (const {section: [address, page, title, text]} of found) {
    const link = document.createElement("a");
    link.href = address;
    link.textContent = page === title ? page : page + ": " + title;
    const words_around = document.createElement("small");
    words_around.textContent = excerpt(text, words[0]);
    const line = document.createElement("p");
    line.append(link, words_around);
    hits.append(line);
  }
}

query.addEventListener("input", show);
