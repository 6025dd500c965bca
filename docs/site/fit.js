// Tables that are wider than the page are reduced to its width, to 60 % at most: beyond, they are scrolled, as equations are. On narrow
// pages equations begin at the left, beside their number.
const fit = () => {
  for (const table of document.querySelectorAll(".md-typeset__table")) {
    let percent = 100;
    do table.style.fontSize = `${percent}%`;
    while (table.scrollWidth > table.parentElement.clientWidth && (percent -= 2) > 60);
  }
};
window.MathJax = {
  options: { enableMenu: false },
  tex: { tagIndent: "0" },
  svg: { displayAlign: innerWidth < 720 ? "left" : "center" },
};
for (const event of ["load", "resize"]) addEventListener(event, fit);
