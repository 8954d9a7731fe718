// The visible part of the world, and a painter that draws it on a canvas or writes it as SVG.

const View = (() => {
  const view = { x: 0, y: 0, scale: 30 };  // the point in the middle, pixels per metre

  // Shows a box, with a margin at its sides and more where text lies over the scene; all in pixels.
  function fit(box, width, height, margin, above, below) {
    const w = Math.max(1, box[2] - box[0]), h = Math.max(1, box[3] - box[1]);
    view.scale = Math.max(1, Math.min((width - 2 * margin) / w, (height - above - below) / h, 120));
    view.x = (box[0] + box[2]) / 2;
    view.y = (box[1] + box[3]) / 2 + (above - below) / 2 / view.scale;
  }
  const toScreen = ([x, y], width, height) => [width / 2 + (x - view.x) * view.scale, height / 2 - (y - view.y) * view.scale];
  const toWorld = ([x, y], width, height) => [view.x + (x - width / 2) / view.scale, view.y - (y - height / 2) / view.scale];
  function zoom(factor, at, width, height) {
    const before = toWorld(at, width, height);
    view.scale = Math.min(800, Math.max(0.5, view.scale * factor));
    const after = toWorld(at, width, height);
    view.x += before[0] - after[0];
    view.y += before[1] - after[1];
  }
  return { view, fit, toScreen, toWorld, zoom };
})();

// Draws in metres. Style: {fill, stroke, width (pixels), opacity, dash}.
class CanvasPainter {
  constructor(context, width, height, view) {
    this.context = context; this.width = width; this.height = height; this.view = view;
  }
  at([x, y]) { return [this.width / 2 + (x - this.view.x) * this.view.scale, this.height / 2 - (y - this.view.y) * this.view.scale]; }
  paint(style, path) {
    const c = this.context;
    c.save();
    c.globalAlpha = style.opacity === undefined ? 1 : style.opacity;
    c.beginPath();
    path(c);
    if (style.fill) { c.fillStyle = style.fill; c.fill(); }
    if (style.stroke) {
      c.strokeStyle = style.stroke; c.lineWidth = style.width || 1; c.lineJoin = 'round'; c.lineCap = style.cap || 'round';
      c.setLineDash(style.dash || []);
      c.stroke();
    }
    c.restore();
  }
  shape(points, style, closed = true) {
    if (!points.length) return;
    this.paint(style, c => { points.forEach((point, i) => { const [x, y] = this.at(point); if (i) c.lineTo(x, y); else c.moveTo(x, y); }); if (closed) c.closePath(); });
  }
  // Many separate lines in one call: pairs of points.
  segments(pairs, style) {
    this.paint(style, c => { for (const [a, b] of pairs) { const p = this.at(a), q = this.at(b); c.moveTo(p[0], p[1]); c.lineTo(q[0], q[1]); } });
  }
  disc(point, radius, style, inMetres = false) {
    this.paint(style, c => { const [x, y] = this.at(point); c.arc(x, y, inMetres ? radius * this.view.scale : radius, 0, 2 * Math.PI); });
  }
  text(point, words, style) {
    const c = this.context, [x, y] = this.at(point);
    c.save();
    c.font = style.font || '600 12px system-ui, sans-serif';
    c.textAlign = style.align || 'center'; c.textBaseline = 'middle';
    if (style.halo) { c.strokeStyle = style.halo; c.lineWidth = 4; c.lineJoin = 'round'; c.strokeText(words, x, y + (style.dy || 0)); }
    c.fillStyle = style.fill;
    c.fillText(words, x, y + (style.dy || 0));
    c.restore();
  }
  image(picture, origin, metresPerPixel, rows, smooth = false) {
    const c = this.context, s = this.view.scale * metresPerPixel, [x, y] = this.at(origin);
    c.save();
    c.translate(x, y);
    c.rotate(-origin[2]);
    c.imageSmoothingEnabled = smooth;
    c.drawImage(picture, 0, -rows * s, picture.width * s, rows * s);
    c.restore();
  }
}

class SvgPainter {
  constructor(width, height, view) { this.width = width; this.height = height; this.view = view; this.parts = []; }
  at(point) { return CanvasPainter.prototype.at.call(this, point).map(value => Math.round(value * 100) / 100); }
  attributes(style) {
    return `fill="${style.fill || 'none'}"` + (style.stroke ? ` stroke="${style.stroke}" stroke-width="${style.width || 1}" stroke-linejoin="round" stroke-linecap="round"` : '') +
      (style.dash ? ` stroke-dasharray="${style.dash.join(' ')}"` : '') + (style.opacity === undefined ? '' : ` opacity="${style.opacity}"`);
  }
  shape(points, style, closed = true) {
    if (points.length) this.parts.push(`<path d="M${points.map(point => this.at(point).join(' ')).join('L')}${closed ? 'Z' : ''}" ${this.attributes(style)}/>`);
  }
  segments(pairs, style) { this.parts.push(`<path d="${pairs.map(([a, b]) => `M${this.at(a).join(' ')}L${this.at(b).join(' ')}`).join('')}" ${this.attributes(style)}/>`); }
  disc(point, radius, style, inMetres = false) {
    const [x, y] = this.at(point);
    this.parts.push(`<circle cx="${x}" cy="${y}" r="${inMetres ? radius * this.view.scale : radius}" ${this.attributes(style)}/>`);
  }
  text(point, words, style) {
    const [x, y] = this.at(point), clean = words.replace(/[<>&"]/g, each => `&#${each.charCodeAt(0)};`);
    this.parts.push(`<text x="${x}" y="${y + (style.dy || 0)}" fill="${style.fill}" font-family="sans-serif" font-size="12" font-weight="600" text-anchor="middle" dominant-baseline="middle">${clean}</text>`);
  }
  image(picture, origin, metresPerPixel, rows, smooth = false) {
    const s = this.view.scale * metresPerPixel, [x, y] = this.at(origin);
    this.parts.push(`<image href="${picture.toDataURL('image/png')}" width="${picture.width * s}" height="${rows * s}" style="image-rendering:${smooth ? 'auto' : 'pixelated'}" transform="translate(${x} ${y}) rotate(${-origin[2] * 180 / Math.PI}) translate(0 ${-rows * s})"/>`);
  }
  toString(background) {
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${this.width} ${this.height}" width="${this.width}" height="${this.height}"><rect width="100%" height="100%" fill="${background}"/>${this.parts.join('\n')}</svg>\n`;
  }
}
