'use strict';
(() => {
    const data = JSON.parse(document.getElementById('data').textContent);
    const tip = document.getElementById('tip');
    const hidden = new Set();
    const all = (selector, root) => Array.from((root || document).querySelectorAll(selector));

    // ---- the box beside the pointer
    function place(event) {
        const box = tip.getBoundingClientRect(), gap = 14;
        const x = event.clientX + gap + box.width > innerWidth ? event.clientX - gap - box.width : event.clientX + gap;
        const y = event.clientY + gap + box.height > innerHeight ? event.clientY - gap - box.height : event.clientY + gap;
        tip.style.left = Math.max(4, x) + 'px';
        tip.style.top = Math.max(4, y) + 'px';
    }
    function show(event, content) {
        tip.replaceChildren(content);
        tip.hidden = false;
        place(event);
    }
    const hide = () => { tip.hidden = true; };

    function time(seconds) {
        const digits = value => value.toPrecision(3).includes('e') ? value.toFixed(0) : value.toPrecision(3);
        return seconds < 1e-3 ? digits(1e6 * seconds) + ' µs' : seconds < 1 ? digits(1e3 * seconds) + ' ms'
            : digits(seconds) + ' s';
    }
    const metres = value => value === null ? '∞' : value.toFixed(2);

    // ---- curves: the values of all planners at the pointer's time
    function last(times, at) {
        let low = 0, high = times.length;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (times[middle] <= at) low = middle + 1; else high = middle;
        }
        return low - 1;
    }
    function curves(svg, chart) {
        const cursor = document.createElementNS('http://www.w3.org/2000/svg', 'path');
        cursor.setAttribute('class', 'cursor');
        svg.addEventListener('mousemove', event => {
            const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
            const share = (point.x - chart.begin) / (chart.end - chart.begin);
            if (share < 0 || share > 1 || point.y < chart.top - 6 || point.y > chart.bottom + 6) {
                cursor.remove();
                return hide();
            }
            const at = chart.low * Math.pow(chart.high / chart.low, share);
            cursor.setAttribute('d', `M${point.x} ${chart.top}V${chart.bottom}`);
            svg.append(cursor);
            const rows = [];
            for (const series of chart.series) {
                if (hidden.has(series.p)) continue;
                const k = last(series.t, at);
                if (k >= 0) rows.push({series, k, value: series.y[k]});
                else if (chart.kind === 'cost') rows.push({series, k, value: Infinity});
            }
            rows.sort((a, b) => chart.kind === 'cost' ? a.value - b.value : b.value - a.value);
            const table = document.createElement('table');
            const caption = document.createElement('b');
            caption.textContent = chart.kind === 'profile' ? `at most ${at.toPrecision(3)} times the best` : 'by ' + time(at);
            for (const {series, k, value} of rows) {
                const row = table.insertRow();
                const swatch = document.querySelector(`.chip[data-p="${series.p}"] svg`);
                const name = row.insertCell();
                if (swatch) name.append(swatch.cloneNode(true));
                name.append(data.planners[series.p]);
                row.insertCell().textContent = chart.kind === 'expected' ? value.toFixed(1)
                    : chart.kind !== 'cost' ? (100 * value).toFixed(0) + ' %'
                    : value === Infinity ? '∞' : metres(value) + ' m';
                row.insertCell().textContent = series.l && k >= 0
                    ? `${metres(series.l[k])} – ${metres(series.h[k])}` : '';
            }
            const content = document.createElement('div');
            content.append(caption, table);
            show(event, content);
        });
        svg.addEventListener('mouseleave', () => { cursor.remove(); hide(); });
    }
    for (const [name, chart] of Object.entries(data.charts)) {
        const svg = document.getElementById(name);
        if (svg) curves(svg, chart);
    }

    // ---- everything else that has something to say
    document.addEventListener('mouseover', event => {
        const target = event.target.closest && event.target.closest('[data-tip]');
        if (target) show(event, document.createTextNode(target.dataset.tip));
    });
    document.addEventListener('mousemove', event => {
        if (!tip.hidden && event.target.closest && event.target.closest('[data-tip]')) place(event);
    });
    document.addEventListener('mouseout', event => {
        if (event.target.closest && event.target.closest('[data-tip]')) hide();
    });

    // ---- planners: point at one to emphasise it, click to show or hide it
    const byPlanner = new Map();
    for (const element of all('[data-p]')) {
        const p = Number(element.dataset.p);
        if (!byPlanner.has(p)) byPlanner.set(p, []);
        byPlanner.get(p).push(element);
    }
    function emphasise(p) {
        for (const element of all('.hot')) element.classList.remove('hot');
        document.body.classList.toggle('emphasis', p !== null);
        if (p !== null) for (const element of byPlanner.get(p)) element.classList.add('hot');
    }
    for (const chip of all('.chip')) {
        const p = Number(chip.dataset.p);
        chip.addEventListener('mouseenter', () => emphasise(p));
        chip.addEventListener('mouseleave', () => emphasise(null));
        chip.addEventListener('click', () => {
            const off = !hidden.has(p);
            if (off) hidden.add(p); else hidden.delete(p);
            chip.setAttribute('aria-pressed', String(!off));
            for (const element of byPlanner.get(p)) if (element !== chip) element.classList.toggle('off', off);
        });
    }

    // ---- tables sorted by a click on a heading
    for (const table of all('table.sortable')) {
        const headings = all('thead th', table), body = table.tBodies[0], original = Array.from(body.rows);
        headings.forEach((heading, column) => heading.addEventListener('click', () => {
            const now = heading.getAttribute('aria-sort');
            headings.forEach(each => each.removeAttribute('aria-sort'));
            const next = now === 'ascending' ? 'descending' : now === 'descending' ? null : 'ascending';
            const key = row => {
                const cell = row.cells[column], value = cell.dataset.sort;
                return value === undefined ? cell.textContent.toLowerCase() : value === 'inf' ? Infinity : Number(value);
            };
            const rows = original.slice();
            if (next) {
                heading.setAttribute('aria-sort', next);
                const sign = next === 'ascending' ? 1 : -1;
                rows.sort((a, b) => {
                    const x = key(a), y = key(b);
                    return x === y ? 0 : sign * (x < y ? -1 : 1);
                });
            }
            body.append(...rows);
        }));
    }
})();
