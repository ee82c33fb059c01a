// A plot as a PNG: its title and units above the chart, on the theme's ground.
import { cssValue } from "../../app/theme.ts";

const HEAD_PX = 24;

export function plotPicture(chart: HTMLCanvasElement, title: string): Promise<Blob | null> {
  const density = window.devicePixelRatio || 1;
  const canvas = document.createElement("canvas");
  canvas.width = chart.width;
  canvas.height = chart.height + HEAD_PX * density;
  const pen = canvas.getContext("2d");
  if (pen === null) return Promise.resolve(null);
  pen.fillStyle = cssValue("--panel");
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = cssValue("--text");
  pen.font = `${13 * density}px system-ui, sans-serif`;
  pen.fillText(title, 10 * density, 17 * density);
  pen.drawImage(chart, 0, HEAD_PX * density);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}
