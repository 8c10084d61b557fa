// node check_pages.cjs MODULES CHROMIUM PAGE.. : checks each page, exits with 1 after the first line
// that says what is wrong. See README.md.
'use strict';
const fs = require('fs');
const path = require('path');
const [modules, chromium, ...pages] = process.argv.slice(2);
const load = (name) => require(require.resolve(name, {paths: [modules]}));
const puppeteer = load('puppeteer-core');
const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js', {paths: [modules]}), 'utf8');
const {HtmlValidate} = load('html-validate');

const problems = [];
function expect(holds, text) {
  if (!holds) problems.push(text);
}

// Void elements are closed in their tag, because the page is XML, too.
async function checkMarkup(name, text) {
  const validator = new HtmlValidate(
      {root: true, extends: ['html-validate:standard'], rules: {'void-style': 'off'}});
  const report = await validator.validateString(text);
  for (const result of report.results) {
    for (const message of result.messages.slice(0, 5)) {
      problems.push(`${name}:${message.line}: ${message.message}`);
    }
  }
}

async function open(browser, file, width, scheme, withScript) {
  const page = await browser.newPage();
  const requests = [], errors = [];
  page.on('request', (request) => {
    if (!request.url().startsWith('data:')) requests.push(request.url());
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  await page.setJavaScriptEnabled(withScript);
  await page.setViewport({width: width, height: 900});
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
  await page.goto('file://' + path.resolve(file));
  return {page, requests, errors};
}

// The text of the document without the script's own parts, from the tree and not from its look.
const readText = () => {
  const copy = document.body.cloneNode(true);
  copy.querySelectorAll('.tools, .theme, .open-3d, script').forEach((part) => part.remove());
  return copy.textContent.replace(/\s+/g, ' ');
};

async function checkLook(browser, file, width, scheme) {
  const where = `${file} at ${width} px, ${scheme}`;
  const {page, requests, errors} = await open(browser, file, width, scheme, true);
  expect(requests.length === 1, `${where}: asks for ${requests.slice(1)}`);
  expect(errors.length === 0, `${where}: ${errors[0]}`);
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  expect(overflow <= 0, `${where}: the page scrolls sideways by ${overflow} px`);
  await page.evaluate(axe);
  const violations = await page.evaluate(async () => {
    document.querySelectorAll('details').forEach((fold) => { fold.open = true; });
    return (await window.axe.run(document)).violations.map(
        (violation) => violation.help + ': ' + violation.nodes[0].html.slice(0, 120));
  });
  for (const violation of violations) problems.push(`${where}: ${violation}`);
  const text = await page.evaluate(readText);
  await page.close();
  return text;
}

// Sorting, filtering, the CSV and the switch of light and dark, on the page's longest table.
async function checkScript(browser, file) {
  const {page} = await open(browser, file, 1280, 'light', true);
  const found = await page.evaluate(async () => {
    const blobs = [];
    URL.createObjectURL = (blob) => { blobs.push(blob); return '#'; };
    const tables = Array.from(document.querySelectorAll('.scroll > table'))
        .sort((a, b) => b.rows.length - a.rows.length);
    const table = tables[0];
    for (let fold = table; fold; fold = fold.parentElement) {
      if (fold.nodeName === 'DETAILS') fold.open = true;
    }
    await new Promise((done) => setTimeout(done));
    await new Promise((done) => requestAnimationFrame(done));
    const frame = table.parentNode, tools = frame.previousElementSibling;
    const rows = Array.from(table.tBodies[0].rows), first = rows[0].cells[0].textContent;
    tools.querySelector('button').click();
    const csv = await blobs[0].text();
    const head = table.tHead.rows[0].cells[0];
    head.querySelector('button').click();
    const sorted = head.getAttribute('aria-sort');
    head.querySelector('button').click();
    head.querySelector('button').click();
    const restored = Array.from(table.tBodies[0].rows).every((row, i) => row === rows[i]);
    const input = tools.querySelector('input');
    let shown = -1;
    if (input) {
      input.value = first;
      input.dispatchEvent(new Event('input'));
      shown = rows.filter((row) => !row.hidden).length;
    }
    const before = getComputedStyle(document.body).backgroundColor;
    document.querySelector('.theme').click();
    return {lines: csv.trim().split('\n').length, rows: table.rows.length, sorted, restored, shown,
            themed: before !== getComputedStyle(document.body).backgroundColor};
  });
  expect(found.lines === found.rows, `${file}: CSV of ${found.lines} lines, ${found.rows} rows`);
  expect(found.sorted === 'ascending', `${file}: sorted ${found.sorted}`);
  expect(found.restored, `${file}: the third click does not restore the order`);
  expect(found.shown !== 0, `${file}: a filter hides the row it names`);
  expect(found.themed, `${file}: the switch of light and dark changes nothing`);
  await page.close();
}

async function main() {
  const browser = await puppeteer.launch({
    executablePath: chromium,
    args: ['--no-sandbox', '--disable-gpu', '--host-resolver-rules=MAP * ~NOTFOUND'],
    protocolTimeout: 1800000,
  });
  for (const file of pages) {
    await checkMarkup(file, fs.readFileSync(file, 'utf8'));
    let text = '';
    for (const scheme of ['light', 'dark']) {
      for (const width of [1280, 320]) text = await checkLook(browser, file, width, scheme);
    }
    const plain = await open(browser, file, 1280, 'light', false);
    expect(await plain.page.evaluate(readText) === text, `${file}: differs without script`);
    await plain.page.close();
    await checkScript(browser, file);
  }
  await browser.close();
  for (const problem of problems) console.log(problem);
  console.log(`${pages.length} pages, ${problems.length} problems`);
  process.exitCode = problems.length === 0 ? 0 : 1;
}

main();
