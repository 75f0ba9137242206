#!/usr/bin/python3
"""Opens pages of `atrapos report` in a headless Chromium, and clicks.

    testReportPage.py ATRAPOS FOLDER      runs decks with that command in FOLDER, which is made anew

Exits with 77, and says why, where Chromium or its driver is not installed. Screenshots stay in FOLDER."""

import os
import shutil
import subprocess
import sys
import time

SKIPPED = 77
TITLE = "</script><script>document.title='owned'</script><!-- `x` ${1} <img src=x onerror=alert(1)> & äöü"

CONTACT_DECK = """title: "%s"
mesh: {file: box.exo, generate: {shape: box, lengths: [4, 1, 1], divisions: [8, 2, 2], cell: HEX20}}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}
supports:
  clamp: {set: x_min, x: 0, y: 0, z: 0}
loads:
  tip: {type: surface, set: x_max, total: [0, 0, -10]}
tools:
  roll: {type: cylinder, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1, motion: {shift: [0, 0, 0.1]}}
contact:
  lower: {tool: roll, set: z_min, stiffness: 1000, regularisation: 1.0e-3}
path: {order: 15, residual: 1.0e-8, stop: {load_factor: 0.5}}
output:
  monitors:
    tip_uz: {type: displacement, set: x_max, component: z}
    force: {type: contact_force, contact: lower}
"""

try:
    from selenium import webdriver
    from selenium.webdriver import ActionChains
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import Select
except ImportError:
    print("skipped: Debian's python3-selenium is not installed")
    sys.exit(SKIPPED)

for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
    if not shutil.which(program):
        print(f"skipped: Debian's {package} is not installed")
        sys.exit(SKIPPED)


def check(what, good, seen=""):
    if not good:
        raise AssertionError(f"{what}: {seen}")


def atrapos(command, folder, *words):
    done = subprocess.run([command, *words], cwd=folder, capture_output=True, text=True, check=False)
    check(" ".join(words), done.returncode == 0, done.stderr)
    return done.stdout


class Page:
    """A page in a browser that has drawn it."""

    def __init__(self, browser, file):
        self.browser = browser
        browser.get("file://" + file)
        self.wait("the page is drawn", lambda: self.js("return document.body.dataset.ready") == "yes")
        errors = [e["message"] for e in browser.get_log("browser") if e["level"] == "SEVERE"]
        check("no errors", not errors, errors)
        check("nothing is loaded", self.js("return performance.getEntriesByType('resource').length") == 0)

    def js(self, code, *words):
        return self.browser.execute_script(code, *words)

    def wait(self, what, done, seconds=60):
        end = time.time() + seconds
        while not done():
            check(what, time.time() < end)
            time.sleep(0.05)

    def one(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def at(self, selector, part_x, part_y):
        """Mouse actions that begin at a part of an element's width and height."""
        element = self.one(selector)
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        size = element.size
        return ActionChains(self.browser).move_to_element_with_offset(
            element, (part_x - 0.5) * size["width"], (part_y - 0.5) * size["height"])


def check_snap_through(page):
    """The truss: a dotted stretch between two limit points, which the thick ones end at."""
    pieces = page.js("""return Array.from(document.querySelectorAll('#path-plot path[data-stability]'),
        p => [p.dataset.stability, p.getAttribute('d')])""")
    check("stretches", [p[0] for p in pieces] == ["stable", "unstable", "stable"], pieces)
    marks = page.js("""return Array.from(document.querySelectorAll('#path-plot .mark'), m => m.getAttribute('transform')
        .match(/[-\\d.]+/g).map(Number))""")
    check("marks", len(marks) == 2, marks)

    def ends(piece):
        points = [tuple(map(float, p.split(","))) for p in piece[1].lstrip("M").split("L")]
        return points[0], points[-1]

    # The path's text has three digits behind the point.
    close = lambda a, b: abs(a[0] - b[0]) < 2e-3 and abs(a[1] - b[1]) < 2e-3
    check("the thick line ends at the limit point", close(ends(pieces[0])[1], marks[0]), (pieces[0], marks))
    check("the dotted one goes from there", close(ends(pieces[1])[0], marks[0]))
    check("to the other one", close(ends(pieces[1])[1], marks[1]))
    labels = [m.text for m in page.all("#path-plot .mark text")]
    check("labels", labels == ["0.3849", "-0.3849"], labels)
    check("no shape", not page.all("#shape"))
    page.all("#points tbody tr")[1].click()
    chosen = page.js("const c = document.querySelector('#path-plot .chosen'); return [c.cx.baseVal.value, c.cy.baseVal.value]")
    check("a click on a row shows the point", close(chosen, marks[1]), (chosen, marks))


def check_contact(page):
    check("the title is text", page.one("h1").text == TITLE, page.one("h1").text)
    check("the page has it too", page.browser.title.startswith("</script>"), page.browser.title)
    check("no element came of it", not page.all("img"))
    check("the deck is there", TITLE in page.one("#deck").get_attribute("textContent"))

    picture = lambda: page.js("return document.getElementById('shape').toDataURL()")
    says = lambda name: int(page.one("#shape-says").get_attribute("data-" + name))
    states = int(page.one("#shape-state").get_attribute("max")) + 1
    check("states", states > 3 and says("state") == states - 1, states)
    end = picture()
    page.js("const s = document.getElementById('shape-state'); s.value = 1; s.dispatchEvent(new Event('input'))")
    check("the slider goes along the path", says("state") == 1, page.one("#shape-says").text)
    early = picture()
    check("the shape changes with it", early != end)
    check("the steps follow", "step 1 " in page.one("#decay-plot").find_element(By.XPATH, "..").text)
    page.at("#shape", 0.5, 0.5).click_and_hold().move_by_offset(120, 40).release().perform()
    check("it turns under the mouse", picture() != early)
    turned = picture()
    page.js("document.getElementById('shape-tools').click()")
    check("tools can be hidden", picture() != turned)
    page.js("document.getElementById('shape-tools').click()")
    check("and shown", picture() == turned)
    field = Select(page.one("#shape-field"))
    check("fields", len(field.options) > 6, [o.text for o in field.options])
    field.select_by_visible_text("stress_xx")
    check("colours by field", picture() != turned)
    check("a field's name stands below", "stress_xx" in page.one(".ramp").text, page.one(".ramp").text)

    circle = page.js("""const p = document.querySelector('#path-plot path[data-stability]');
        const q = p.getPointAtLength(p.getTotalLength()), s = p.ownerSVGElement;
        return [q.x / s.clientWidth, q.y / s.clientHeight]""")
    page.at("#path-plot svg", *circle).perform()
    tip = page.one("#path-plot .tip")
    check("hover shows the values", "load factor = 0.5" in tip.text and "tip_uz = " in tip.text, tip.text)
    page.at("#path-plot svg", *circle).click().perform()
    check("a click shows that state", says("state") == states - 1, page.one("#shape-says").text)

    Select(page.one("#path-y")).select_by_visible_text("force")
    Select(page.one("#path-x")).select_by_visible_text("load factor")
    names = [t.text for t in page.all("#path-plot .label")]
    check("any monitor over any other", names == ["load factor", "force"], names)
    page.js("document.querySelector('#events tbody tr').click()")
    check("events lead to their place", says("state") < states - 1, page.one("#shape-says").text)
    check("time by part", len(page.all("#time .part")) >= 7)


def main(command, folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    with open(os.path.join(folder, "contact.yaml"), "w", encoding="utf-8") as deck:
        deck.write(CONTACT_DECK % TITLE)
    with open(os.path.join(folder, "truss.yaml"), "w", encoding="utf-8") as deck:
        deck.write("problem: {name: von_mises_truss}\noutput: {points_per_step: 20}\n")
    atrapos(command, folder, "mesh", "-q", "contact.yaml")
    said = atrapos(command, folder, "run", "contact.yaml", "-o", "contact")
    check("the run names its page", said.splitlines()[-1] == "open contact/report.html in a browser", said)
    atrapos(command, folder, "run", "-q", "truss.yaml", "-o", "truss")
    said = atrapos(command, folder, "report", "truss", "-o", "page.html")
    check("the command names the page", said == "page.html\n", said)

    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage",
                 "--window-size=1280,1600", "--host-resolver-rules=MAP * ~NOTFOUND", "--user-data-dir=" + os.path.join(folder, "profile")):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    try:
        for name, file, look in (("truss", "page.html", check_snap_through), ("contact", "contact/report.html", check_contact)):
            page = Page(browser, os.path.join(folder, file))
            look(page)
            page.js("window.scrollTo(0, 0)")
            browser.save_screenshot(os.path.join(folder, name + ".png"))
    finally:
        browser.quit()
    shutil.rmtree(os.path.join(folder, "profile"), ignore_errors=True)
    print("both pages are as they should be; screenshots in", folder)


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]))
