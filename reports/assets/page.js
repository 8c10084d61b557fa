// Adds to the finished page what needs a script: sorting, filtering and downloads of tables,
// downloads of figures, a switch of light and dark. No number depends on it.
(function () {
  'use strict';
  var few = 8;  // rows of a table that needs no filter

  function make(tag, attributes, text) {
    var element = document.createElement(tag);
    for (var name in attributes) element.setAttribute(name, attributes[name]);
    if (text) element.textContent = text;
    return element;
  }

  function makeButton(text, label, action) {
    var button = make('button', {type: 'button', 'aria-label': label}, text);
    button.addEventListener('click', action);
    return button;
  }

  function save(name, type, text) {
    var url = URL.createObjectURL(new Blob([text], {type: type}));
    var link = make('a', {href: url, download: name});
    document.body.appendChild(link);
    link.click();
    link.remove();
    setTimeout(function () { URL.revokeObjectURL(url); }, 60000);
  }

  function textOf(cell) {
    return cell ? cell.textContent.replace(/[ \t\n]+/g, ' ').trim() : '';
  }

  // Spreadsheets run a text that begins with one of these; RFC 4180 for the rest.
  function formatCell(text) {
    var isNumber = /^[-+]?\d+(\.\d+)?(e[-+]?\d+)?$/i.test(text);
    if (/^'*[=+\-@\x00-\x1f]/.test(text) && !isNumber) text = "'" + text;
    return /[",\r\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  }

  function formatCsv(table) {
    return Array.from(table.rows, function (row) {
      return Array.from(row.cells, function (cell) { return formatCell(textOf(cell)); }).join(',');
    }).join('\n') + '\n';
  }

  // Numbers by value, texts by the rules of the language, what is missing last.
  function compareTexts(a, b, direction) {
    var x = parseFloat(a), y = parseFloat(b);
    if (isNaN(x) && isNaN(y)) {
      return direction * a.localeCompare(b, undefined, {numeric: true});
    }
    if (isNaN(x) || isNaN(y)) return isNaN(x) ? 1 : -1;
    return direction * (x - y);
  }

  function sortBy(table, head, original) {
    var next = {none: 'ascending', ascending: 'descending', descending: 'none'};
    var order = next[head.getAttribute('aria-sort') || 'none'];
    Array.from(head.parentNode.cells, function (cell) { cell.setAttribute('aria-sort', 'none'); });
    head.setAttribute('aria-sort', order);
    var rows = original.slice();
    if (order !== 'none') {
      rows.sort(function (a, b) {
        return compareTexts(textOf(a.cells[head.cellIndex]), textOf(b.cells[head.cellIndex]),
                            order === 'ascending' ? 1 : -1);
      });
    }
    var body = table.tBodies[0];
    rows.forEach(function (row) { body.appendChild(row); });
  }

  function makeFilter(table, name, rows) {
    var input = make('input', {type: 'search', placeholder: 'Filter rows',
                               'aria-label': 'Rows to show of ' + name});
    var count = make('span', {role: 'status'});
    input.addEventListener('input', function () {
      var words = input.value.toLowerCase().split(' '), shown = 0;
      rows.forEach(function (row) {
        var text = textOf(row).toLowerCase();
        row.hidden = !words.every(function (word) { return text.indexOf(word) >= 0; });
        if (!row.hidden) shown += 1;
      });
      count.textContent = input.value ? shown + ' of ' + rows.length + ' rows' : '';
    });
    return [input, count];
  }

  function equipTable(table) {
    var frame = table.parentNode;
    if (table.hasAttribute('data-tools') || !table.tHead || !table.tBodies.length) return;
    table.setAttribute('data-tools', '');
    var name = textOf(table.caption), rows = Array.from(table.tBodies[0].rows);
    var tools = make('div', {'class': 'tools'});
    if (rows.length >= few) makeFilter(table, name, rows).forEach(function (part) {
      tools.appendChild(part);
    });
    tools.appendChild(makeButton('CSV', 'Download as CSV: ' + name, function () {
      save((frame.id || 'table') + '.csv', 'text/csv', formatCsv(table));
    }));
    frame.parentNode.insertBefore(tools, frame);
    if (rows.length < 2) return;
    Array.from(table.tHead.rows[0].cells, function (head) {
      var button = make('button', {type: 'button', 'class': 'sort'});
      while (head.firstChild) button.appendChild(head.firstChild);
      head.appendChild(button);
      head.setAttribute('aria-sort', 'none');
      button.addEventListener('click', function () { sortBy(table, head, rows); });
    });
  }

  // The style sheet does not travel with a file, so every element gets its own style.
  function formatSvg(svg) {
    var names = ['fill', 'fill-opacity', 'stroke', 'stroke-width', 'stroke-dasharray',
                 'font-family', 'font-size', 'font-weight', 'text-anchor', 'dominant-baseline'];
    var copy = svg.cloneNode(true);
    var from = svg.querySelectorAll('*'), to = copy.querySelectorAll('*');
    for (var i = 0; i < from.length; ++i) {
      if (/^(title|desc)$/.test(from[i].nodeName)) continue;
      var style = getComputedStyle(from[i]);
      names.forEach(function (name) { to[i].style.setProperty(name, style.getPropertyValue(name)); });
    }
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    copy.style.background = getComputedStyle(document.body).backgroundColor;
    return new XMLSerializer().serializeToString(copy);
  }

  function equipFigure(figure) {
    var svg = figure.querySelector('svg.plot');
    if (!svg || figure.hasAttribute('data-tools')) return;
    figure.setAttribute('data-tools', '');
    var tools = make('div', {'class': 'tools'});
    tools.appendChild(makeButton('SVG', 'Download as SVG: ' + svg.querySelector('title').textContent,
                                 function () {
      save(figure.id + '.svg', 'image/svg+xml', formatSvg(svg));
    }));
    figure.appendChild(tools);
  }

  // What is folded gets its tools when it is opened.
  function equip(root) {
    function isFolded(element) {
      var fold = element.parentNode.closest('details:not([open])');
      return fold && root.contains(fold);
    }
    root.querySelectorAll('.scroll > table').forEach(function (table) {
      if (!isFolded(table)) equipTable(table);
    });
    root.querySelectorAll('figure[id]').forEach(function (figure) {
      if (!isFolded(figure)) equipFigure(figure);
    });
  }

  function unfold(element) {
    for (var fold = element; fold; fold = fold.parentElement) {
      if (fold.nodeName === 'DETAILS') fold.open = true;
    }
  }

  function reveal() {
    var target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    unfold(target);
    if (target) target.scrollIntoView();
  }

  function addThemeSwitch() {
    var rules = Array.from(document.styleSheets[0].cssRules).filter(function (rule) {
      return rule.media && rule.media.mediaText.indexOf('prefers-color-scheme') >= 0;
    });
    var isDark = matchMedia('(prefers-color-scheme: dark)').matches;
    var button = makeButton('', 'Light or dark', function () { isDark = !isDark; show(); });
    function tell() { button.textContent = isDark ? 'Light' : 'Dark'; }
    function show() {
      rules.forEach(function (rule) { rule.media.mediaText = isDark ? 'screen' : 'not all'; });
      document.documentElement.style.colorScheme = isDark ? 'dark' : 'light';
      tell();
    }
    button.removeAttribute('aria-label');
    button.className = 'theme';
    tell();
    document.querySelector('header').appendChild(button);
  }

  equip(document.body);
  document.addEventListener('toggle', function (event) {
    if (event.target.open) equip(event.target);
  }, true);
  addThemeSwitch();
  window.addEventListener('hashchange', reveal);
  window.addEventListener('beforeprint', function () {
    document.querySelectorAll('details.cell').forEach(unfold);
  });
  if (location.hash) reveal();
}());
