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
    function draw(element) {
        const style = getComputedStyle(document.documentElement), of = name => style.getPropertyValue(name).trim();
        const chart = charts[element.id];
        const axis = {gridcolor: of('--line'), linecolor: of('--line'), tickcolor: of('--line')};
        const layout = {...chart.layout, paper_bgcolor: 'transparent', plot_bgcolor: 'transparent',
            font: {family: style.getPropertyValue('--sans'), size: 11, color: of('--soft')},
            xaxis: {...axis, ...chart.layout.xaxis}, yaxis: {...axis, ...chart.layout.yaxis}};
        const data = chart.data.map(trace => ({...trace, visible: isShown(trace)}));
        element.dataset.drawn = 'yes';
        return Plotly.react(element, data, layout, {responsive: true, displayModeBar: false});
    }
    const drawn = () => all('.chart[data-drawn]');
    const redraw = () => drawn().forEach(draw);

    async function begin() {
        try {
            await loadPlotly();
        } catch (error) {
            all('.chart').forEach(element => { element.textContent = 'This browser is too old to draw charts.'; });
            return;
        }
        // Draws each chart when it is close to the window: few of hundreds are viewed.
        const observer = new IntersectionObserver(entries => entries.forEach(({isIntersecting, target}) => {
            if (isIntersecting) {
                observer.unobserve(target);
                draw(target);
            }
        }), {rootMargin: '600px'});
        all('.chart').forEach(element => observer.observe(element));
        addEventListener('beforeprint', () => all('.chart').forEach(draw));
        matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    }

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

    // Shows the meaning of a figure at the lower edge, by pointer, finger and keyboard.
    const tip = document.getElementById('tip');
    function explain(event) {
        const target = event.target.closest && event.target.closest('[data-tip]');
        tip.hidden = !target;
        tip.textContent = target ? target.dataset.tip : '';
    }
    for (const kind of ['mouseover', 'focusin', 'click']) document.addEventListener(kind, explain);

    begin();
})();
