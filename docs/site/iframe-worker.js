// Search in pages opened as files, where browsers refuse workers: the worker's script runs in a hidden frame instead. The theme
// looks for the name IFrameWorker; its own shim is loaded from the network.
if (location.protocol === "file:")
  window.Worker = window.IFrameWorker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.body.appendChild(Object.assign(document.createElement("iframe"), { hidden: true }));
      const load = (src) =>
        new Promise((resolve, reject) =>
          frame.contentDocument.body.appendChild(
            Object.assign(frame.contentDocument.createElement("script"), { src, onload: resolve, onerror: reject }),
          ),
        );
      frame.contentWindow.importScripts = (...urls) => urls.reduce((before, next) => before.then(() => load(next)), Promise.resolve());
      frame.contentWindow.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      this.frame = frame.contentWindow;
      this.ready = load(url);
    }
    postMessage(data) {
      this.ready.then(() => this.frame.dispatchEvent(new this.frame.MessageEvent("message", { data })));
    }
  };
