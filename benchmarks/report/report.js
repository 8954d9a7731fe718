'use strict';
(() => {
    const all = (selector, root) => Array.from((root || document).querySelectorAll(selector));
    const charts = JSON.parse(document.getElementById('charts').textContent);
    const hidden = new Set();  // planners

    // Plotly's script is compressed: it has megabytes.
    async function loadPlotly() {
        const packed = Uint8Array.from(atob(document.getElementById('plotly').textContent), each => each.charCodeAt(0));
        const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
        const script = document.createElement('script');
        script.textContent = await new Response(stream).text();
        document.head.append(script);
    }

    const isShown = trace => trace.meta === undefined || !hidden.has(trace.meta);
    const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

    // The chart as Plotly's figure in these colours, without the hidden planners.
    function figureOf(name, line, text, ground) {
        const {data, layout} = charts[name], axis = {gridcolor: line, linecolor: line, tickcolor: line};
        return {data: data.map(trace => ({...trace, visible: isShown(trace)})),
            layout: {...layout, paper_bgcolor: ground, plot_bgcolor: ground, font: {family: style('--sans'), size: 11, color: text},
                xaxis: {...axis, ...layout.xaxis}, yaxis: {...axis, ...layout.yaxis}}};
    }
    function draw(element) {
        const {data, layout} = figureOf(element.id, style('--line'), style('--soft'), 'transparent');
        element.dataset.drawn = 'yes';
        return Plotly.react(element, data, layout, {responsive: true, displayModeBar: false});
    }
    const drawn = () => all('.chart[data-drawn]');
    const redraw = () => drawn().forEach(draw);

    // Plotly is loaded with the first chart close to the window.
    let plotly = null;
    const withPlotly = () => plotly || (plotly = loadPlotly());
    async function drawSoon(element) {
        try {
            await withPlotly();
        } catch (error) {
            element.textContent = 'This browser is too old to draw charts.';
            return;
        }
        draw(element);
    }

    // Draws each chart when it is close to the window: few of hundreds are viewed.
    const observer = new IntersectionObserver(entries => entries.forEach(({isIntersecting, target}) => {
        if (isIntersecting) {
            observer.unobserve(target);
            drawSoon(target);
        }
    }), {rootMargin: '300px'});
    all('.chart').forEach(element => observer.observe(element));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    addEventListener('beforeprint', () => {
        all('.problem, #standings details').forEach(element => { element.open = true; });
        if (plotly) all('.chart').forEach(draw);
    });

    // Saves a chart, without the hidden planners, in the colours of paper.
    for (const button of all('.export'))
        button.addEventListener('click', async () => {
            await withPlotly();
            const {offsetWidth: width, offsetHeight: height} = document.getElementById(button.dataset.chart);
            const link = document.createElement('a');
            link.href = await Plotly.toImage(figureOf(button.dataset.chart, '#dfe4ea', '#3d4957', '#ffffff'), {format: 'svg', width, height});
            link.download = button.dataset.chart + '.svg';
            link.click();
        });

    // Planners: each button shows or hides one in tables, charts and pictures.
    for (const chip of all('.chip')) {
        const planner = Number(chip.dataset.p);
        chip.addEventListener('click', () => {
            const isHidden = !hidden.delete(planner);
            if (isHidden) hidden.add(planner);
            chip.setAttribute('aria-pressed', String(!isHidden));
            all(`main [data-p="${planner}"]`).forEach(element => { element.hidden = isHidden; });
            redraw();
        });
    }

    // Sorts tables by a heading: ascending, descending, original order.
    for (const table of all('table')) {
        const body = table.tBodies[0], original = Array.from(body.rows);
        all('thead button', table).forEach((button, column) => button.addEventListener('click', () => {
            const heading = button.parentElement, previous = heading.getAttribute('aria-sort');
            all('thead th', table).forEach(each => each.removeAttribute('aria-sort'));
            const next = {ascending: 'descending', descending: null}[previous];
            const order = next === undefined ? 'ascending' : next;
            const key = row => {
                const {dataset: {sort}, textContent} = row.cells[column];
                return sort === undefined ? textContent.toLowerCase() : sort === 'inf' ? Infinity : Number(sort);
            };
            const rows = original.slice();
            if (order) {
                heading.setAttribute('aria-sort', order);
                const sign = order === 'ascending' ? 1 : -1;
                rows.sort((a, b) => key(a) === key(b) ? 0 : key(a) < key(b) ? -sign : sign);
            }
            body.append(...rows);
        }));
    }

    // Tables that do not fit say so.
    const measure = new ResizeObserver(entries => requestAnimationFrame(() => entries.forEach(({target}) => {
        const area = target.closest('.scroll');
        area.classList.toggle('scrolls', area.scrollWidth > area.clientWidth + 1);
    })));
    all('.scroll').forEach(area => { measure.observe(area); if (area.firstElementChild) measure.observe(area.firstElementChild); });

    // A link into a folded part unfolds it.
    function unfold() {
        const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
        if (!target) return;
        for (let part = target.closest('details'); part; part = part.parentElement.closest('details')) part.open = true;
        target.scrollIntoView();
    }
    addEventListener('hashchange', unfold);
    unfold();

    // A click enlarges a picture; the body then moves along the path.
    const large = document.getElementById('large');
    let moving = 0;  // number of the motion that goes on
    for (const button of all('.drawing'))
        button.addEventListener('click', () => {
            const picture = button.querySelector('svg').cloneNode(true);
            large.querySelector('.view').replaceChildren(picture);
            large.querySelector('.about').textContent = button.nextElementSibling.textContent;
            large.querySelector('.move').hidden = !picture.querySelector('[data-body] polyline');
            large.showModal();
        });
    large.addEventListener('close', () => { ++moving; });
    large.addEventListener('click', event => { if (event.target === large) large.close(); });
    large.querySelector('.move').addEventListener('click', () => {
        const group = large.querySelector('[data-body]'), lines = all('polyline', group), SECONDS = 6;
        const [behind, ahead, beside] = group.dataset.body.split(' ').map(parseFloat);
        const body = document.createElementNS(group.namespaceURI, 'rect');
        const shape = {x: -behind, y: -beside, width: behind + ahead, height: 2 * beside, class: 'body',
            rx: group.dataset.body.endsWith('disc') ? behind : 0.15 * beside};
        for (const name in shape) body.setAttribute(name, shape[name]);
        all('.body', group).forEach(each => each.remove());
        group.append(body);
        const lengths = lines.map(line => line.getTotalLength()), total = lengths.reduce((sum, length) => sum + length, 0);
        const turn = ++moving;
        let begin;
        const frame = now => {
            if (moving !== turn) return;
            begin = begin || now;
            const share = Math.min(1, (now - begin) / 1000 / SECONDS);
            let at = share * total, k = 0;
            while (k + 1 < lines.length && at > lengths[k]) at -= lengths[k++];
            // The heading is the direction of the line, or the opposite one in reverse.
            const near = Math.min(at, lengths[k] - 1), p = lines[k].getPointAtLength(at), a = lines[k].getPointAtLength(near);
            const b = lines[k].getPointAtLength(near + 1), reverse = lines[k].getAttribute('stroke') === '#ea580c';
            const heading = Math.atan2(b.y - a.y, b.x - a.x) * 180 / Math.PI + (reverse ? 180 : 0);
            body.setAttribute('transform', `translate(${p.x} ${p.y}) rotate(${heading})`);
            if (share < 1) requestAnimationFrame(frame);
        };
        requestAnimationFrame(frame);
    });

    // Shows the meaning of a figure at the lower edge, by pointer, finger and keyboard.
    const tip = document.getElementById('tip');
    function explain(event) {
        const target = event.target.closest && event.target.closest('[data-tip]');
        tip.hidden = !target;
        tip.textContent = target ? target.dataset.tip : '';
    }
    for (const kind of ['mouseover', 'focusin', 'click']) document.addEventListener(kind, explain);
})();
