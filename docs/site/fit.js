// Equations and tables that are wider than the page are reduced to its width, tables to 60 % at most: beyond, they are scrolled. On
// narrow pages equations begin at the left, beside their number.
const reduce = (element, container, least) => {
  let percent = 100;
  do element.style.fontSize = `${percent}%`;
  while (container.scrollWidth > container.parentElement.clientWidth && (percent -= 2) > least);
};
const fit = () => {
  for (const equation of document.querySelectorAll("mjx-container[display]")) reduce(equation, equation, 30);
  for (const table of document.querySelectorAll(".md-typeset__table")) reduce(table, table, 60);
};
window.MathJax = {
  options: { enableMenu: false },
  startup: { pageReady: () => MathJax.startup.defaultPageReady().then(fit) },
  tex: { tagIndent: "0" },
  svg: { displayAlign: innerWidth < 720 ? "left" : "center" },
};
for (const event of ["load", "resize"]) addEventListener(event, fit);
