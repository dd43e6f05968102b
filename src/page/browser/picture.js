// Saves the view with legend, names and scale as a PNG file.
import { drawLegend, kWideLegend } from './legend.js';
import { markersOf, scaleOf } from './overlays.js';

export class Picture {
  constructor(viewer, legendPanel) {
    Object.assign(this, { viewer, legendPanel });
  }

  save() {
    const { viewer } = this, { canvas, models } = viewer;
    const ratio = Math.min(devicePixelRatio, 2), width = canvas.clientWidth, height = canvas.clientHeight;
    const picture = document.createElement('canvas');
    Object.assign(picture, { width: (width + kWideLegend.width) * ratio, height: height * ratio });
    const context = picture.getContext('2d'), { ink } = viewer.theme();
    // The view is drawn again, because the pixels of the canvas exist only until the end of a task.
    viewer.draw(true);
    context.fillStyle = getComputedStyle(canvas).backgroundColor;
    context.fillRect(0, 0, picture.width, picture.height);
    context.drawImage(canvas, 0, 0, width * ratio, height * ratio);
    context.scale(ratio, ratio);
    for (const pane of viewer.panes()) {
      context.fillStyle = context.strokeStyle = ink;
      context.font = '13px system-ui, sans-serif';
      if (models.length > 1) context.fillText(models[pane.index].description.label, pane.left + 8, pane.top + 18);
      const { pixels, label } = scaleOf(pane.camera), bottom = pane.top + pane.height;
      context.fillRect(pane.left + 10, bottom - 10, pixels, 2);
      context.fillText(label, pane.left + 10, bottom - 16);
      for (const { x, y, text, isLeft } of markersOf(pane, viewer)) {
        context.beginPath();
        context.arc(x, y, 8, 0, 2 * Math.PI);
        context.stroke();
        context.fillText(text, isLeft ? x - 12 - context.measureText(text).width : x + 12, y + 4);
      }
    }
    context.translate(width, 0);
    drawLegend(context, this.legendPanel.legend(), height, kWideLegend, ink);
    picture.toBlob((blob) => {
      const address = URL.createObjectURL(blob), link = document.createElement('a');
      Object.assign(link, { href: address, download: `${models[0].description.name.replace(/\.\w+$/, '')}.png` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(address), 10000);
    });
  }
}
