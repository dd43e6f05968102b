// Saves the view with its callouts, names, scale and legend as a PNG file.
import { calloutsOf, ringRadius } from './callouts.js';
import { drawLegend, kLegendHeight } from './legend.js';
import { scaleOf } from './overlays.js';

export function saveFile(blob, name) {
  const address = URL.createObjectURL(blob), link = document.createElement('a');
  Object.assign(link, { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

export class Picture {
  constructor(viewer, legendPanel) {
    Object.assign(this, { viewer, legendPanel });
  }

  save() {
    const { viewer } = this, { canvas, models } = viewer;
    const ratio = Math.min(devicePixelRatio, 2), width = canvas.clientWidth, height = canvas.clientHeight;
    const picture = document.createElement('canvas');
    Object.assign(picture, { width: width * ratio, height: (height + kLegendHeight) * ratio });
    const context = picture.getContext('2d'), { ink } = viewer.theme();
    // The view is drawn again, because the pixels of the canvas exist only until the end of a task.
    viewer.draw(true);
    context.fillStyle = getComputedStyle(canvas).backgroundColor;
    context.fillRect(0, 0, picture.width, picture.height);
    context.drawImage(canvas, 0, 0, width * ratio, height * ratio);
    context.scale(ratio, ratio);
    for (const pane of viewer.panes()) {
      context.fillStyle = context.strokeStyle = ink;
      context.font = '600 14px system-ui, sans-serif';
      context.textBaseline = 'middle';
      if (models.length > 1) context.fillText(viewer.titleOf(pane.index), pane.left + 12, pane.top + 18);
      const { pixels, label } = scaleOf(pane.camera, viewer.unit), bottom = pane.top + pane.height;
      context.fillRect(pane.left + 16, bottom - 12, pixels, 2);
      context.fillText(label, pane.left + 16, bottom - 22);
      for (const { x, y, number, text, isLeft, column, row } of calloutsOf(pane, viewer)) {
        const length = Math.hypot(column - x, row - y) || 1, share = Math.min(ringRadius(pane) / length, 1);
        context.beginPath();
        context.arc(x, y, ringRadius(pane), 0, 2 * Math.PI);
        context.moveTo(x + (column - x) * share, y + (row - y) * share);
        context.lineTo(column, row);
        context.stroke();
        context.textAlign = isLeft ? 'right' : 'left';
        context.fillText(isLeft ? `${text}  ${number}` : `${number}  ${text}`, column + (isLeft ? -4 : 4), row);
      }
    }
    context.translate(0, height);
    drawLegend(context, this.legendPanel.legend(), width, ink);
    picture.toBlob((blob) => saveFile(blob, `${models[0].description.name.replace(/\.\w+$/, '')}.png`));
  }
}
