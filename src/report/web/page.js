for (const input of document.querySelectorAll('.compare input')) {
  const move = () => {
    input.parentElement.style.setProperty('--split', input.value + '%');
    input.setAttribute('aria-valuetext', Math.round(input.value) + ' % ' + input.dataset.left +
      ', ' + Math.round(100 - input.value) + ' % ' + input.dataset.right);
  };
  input.addEventListener('input', move);
  input.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'mouse' && event.buttons === 0) return;
    const box = input.getBoundingClientRect();
    input.value = Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width));
    move();
  });
  move();
}
// Folded tables are printed.
window.addEventListener('beforeprint', () => {
  for (const folded of document.querySelectorAll('details')) folded.open = true;
});
