// Decompresses and inserts the script of the page. The content-security policy has the hashes of both scripts.
(async () => {
  const packed = Uint8Array.from(atob(document.getElementById('script').textContent), (letter) => letter.charCodeAt(0));
  const script = document.createElement('script');
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  script.textContent = await new Response(stream).text();
  document.head.append(script);
})().catch(() => {
  document.documentElement.dataset.state = 'error';
  document.getElementById('message').textContent = 'DecompressionStream' in self
    ? 'This page is damaged: write it again with asdf-vk.'
    : 'This browser is too old for this page: it has no DecompressionStream.';
});
