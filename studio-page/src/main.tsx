// First of all, since the route is read from the address as well.
import "./wire/access";
import { render } from "preact";
import { App } from "./frame/app";
import { start } from "./state/studio";
import "./styles/tokens.css";
import "./styles/base.css";
import "./styles/scale.css";
import "./styles/frame.css";
import "./styles/collection.css";
import "./styles/first.css";
import "./styles/inspector.css";
import "./styles/stage.css";
import "./styles/console.css";
import "./styles/loop.css";
import "./styles/history.css";
import "./styles/feedback.css";
import "./styles/explore.css";
import "./styles/parameters.css";
import "./styles/curating.css";
import "./styles/phone.css";

start();
render(<App />, document.getElementById("page")!);
