"""What the tests do at the page does not depend on how fast the computer is."""

from person import drag_in

# A page whose loop is slow: a tick in 200 ms, and a pop at the sixth.
SLOW = """
<div role="application" aria-label="The needle and the membranes" style="height: 600px"></div>
<div class="phases-when">0</div>
<div class="events-list"></div>
<script>
  window.moves = 0;
  document.addEventListener("mousemove", (event) => { if (event.buttons) window.moves++; });
  const when = document.querySelector(".phases-when");
  const tick = () => {
    when.textContent = String(Number(when.textContent) + 1);
    if (when.textContent === "6") document.querySelector(".events-list").innerHTML = '<p class="event pop">pop</p>';
    setTimeout(tick, 200);
  };
  document.addEventListener("mousedown", () => setTimeout(tick, 200));
</script>
"""


def test_a_drag_goes_on_by_a_step_only_when_the_page_shows_that_the_loop_went_on(browser):
    page = browser.new_page()
    page.set_content(SLOW)
    drag_in(page, pops=1)
    assert page.evaluate("window.moves <= Number(document.querySelector('.phases-when').textContent) + 1")
    page.close()
